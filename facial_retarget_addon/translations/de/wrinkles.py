"""Wrinkle kits."""

TEXTS = {
    "Wrinkle Kit": "Faltensatz",
    "Make Wrinkle Kit": "Faltensatz erstellen",
    "Make a map and a mask for each shape key that wrinkles, and let materials blend them by the sliders; Esc stops": (
        "Für jeden Formschlüssel, der Falten wirft, eine Map und eine Maske erstellen, und Materialien sie nach den "
        "Reglern mischen lassen; Esc hält an"
    ),
    "Making the wrinkle kit": "Erstellt den Faltensatz",
    "Remove Wrinkle Kit": "Faltensatz entfernen",
    "Take the wrinkle kit out of the active object's materials; its shape keys and the files stay": (
        "Den Faltensatz aus den Materialien des aktiven Objekts nehmen; seine Formschlüssel und die Dateien bleiben"
    ),
    "Choose the high-poly object": "Das hochaufgelöste Objekt wählen",
    "Choose a folder for the wrinkle kit": "Einen Ordner für den Faltensatz wählen",
    "Wrinkles of": "Falten von",
    "Where the wrinkles come from": "Woher die Falten kommen",
    "Retargeted Keys": "Übertragene",
    "The finest level of the shapes that Cloning gives the target, by the method of step 4": (
        "Die feinste Stufe der Formen, die Klonen dem Ziel gibt, nach der Methode von Schritt 4"
    ),
    "High-Poly Object": "Hochaufgelöstes Objekt",
    "A fine mesh in the target's place that has its shape keys, by their names": (
        "Eine feine Masche am Ort des Ziels, die seine Formschlüssel hat, nach deren Namen"
    ),
    "High-Poly": "Hochaufgelöst",
    "The fine mesh: it lies where the target does, and has shape keys of the same names": (
        "Die feine Masche: sie liegt dort, wo das Ziel liegt, und hat Formschlüssel der gleichen Namen"
    ),
    "Least": "Mindestens",
    "Shape keys that turn no normal by this much get no map": (
        "Formschlüssel, die keine Normale um so viel drehen, bekommen keine Map"
    ),
}

SENTENCES = {
    "Wrinkle kit of {} in {} (keys: {}, pictures: {})": "Faltensatz von {} in {} (Schlüssel: {}, Bilddateien: {})",
    "Wrinkle kit taken out of {} (materials: {})": "Faltensatz aus {} genommen (Materialien: {})",
    "picture {} of {}": "Bilddatei {} von {}",
    "shapes without a key of their name on the target: {}": "Formen ohne gleichnamigen Schlüssel am Ziel: {:said}",
    "keys that wrinkle too little for a map: {}": "Schlüssel mit zu wenig Falten für eine Map: {:said}",
    "the kit has {} pictures, and some graphics cards take {} in an EEVEE material; raise Least if it stays grey "
    "there": (
        "der Satz hat {} Bilddateien, und manche Grafikkarten nehmen {} in einem EEVEE-Material; „Mindestens“ "
        "erhöhen, wenn es dort grau bleibt"
    ),
    "material {} {}: the wrinkle kit is not wired there": (
        "Material {} {:said}: der Faltensatz ist dort nicht angeschlossen"
    ),
    "none of the {} shape keys turns normals by {} degrees, the most is {}; expected keys with wrinkles that the "
    "light mesh lacks": (
        "keiner der {} Formschlüssel dreht Normalen um {} Grad, höchstens um {}; Schlüssel mit Falten wählen, die der "
        "leichten Masche fehlen"
    ),
    "folder {} holds {}; expected a new folder, or one that holds a wrinkle kit and nothing else, since it is "
    "replaced": (
        "Ordner {} enthält {}; er wird ersetzt: einen neuen wählen, oder einen, in dem nur ein Faltensatz liegt"
    ),
    "object {} has none of the {} shape keys that Cloning would give it, expected keys of the same names: clone them "
    "first": "Objekt {} hat keinen der {} Formschlüssel, die Klonen ihm gäbe; sie zuerst klonen",
    "no high-poly object is chosen for the wrinkles, expected another mesh than the target": (
        "kein hochaufgelöstes Objekt ist für die Falten gewählt; eine andere Masche als das Ziel wählen"
    ),
    "objects {} and {} have no shape key of the same name, expected the keys that wrinkle on both": (
        "Objekte {} und {} haben keinen Formschlüssel gleichen Namens; beide brauchen die Schlüssel mit Falten"
    ),
}

PHRASES = {
    "wrinkle kit": "den Faltensatz",
    "{} and {} more": "{} und {} weitere",
}
