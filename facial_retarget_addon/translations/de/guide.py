"""The line on top: what to do next, how long work takes."""

TEXTS = {
    "Import two faces, or try the built-in ones": "Zwei Gesichter importieren, oder die eingebauten ausprobieren",
    "Choose the face that moves": "Das Gesicht wählen, das sich bewegt",
    "Choose the face that shall move": "Das Gesicht wählen, das sich bewegen soll",
    "{face} is not in this scene: choose another face": "{face} ist nicht in dieser Szene: ein anderes Gesicht wählen",
    "Source and target are one object: choose another target": (
        "Quelle und Ziel sind dasselbe Objekt: ein anderes Ziel wählen"
    ),
    "Unhide {face}: Blender moves nothing hidden": "{face} einblenden: Verborgenes bewegt Blender nicht",
    "{face} does not move: animate it, import motion (More, MPEG-4 Face), or choose another source": (
        "{face} bewegt sich nicht: animieren, Bewegung importieren (Weiteres, MPEG-4-Gesicht) oder eine andere Quelle "
        "wählen"
    ),
    "Only {count} points have the same names on both faces: {wanted} must": (
        "Nur {count} Punkte heißen auf beiden Gesichtern gleich: {wanted} müssen es sein"
    ),
    "Look at the {count} proposed points on {face}, then accept them": (
        "Die {count} vorgeschlagenen Punkte auf {face} ansehen, dann annehmen"
    ),
    "Choose a larger set of points for {face}: {count} are missing": (
        "Einen größeren Satz von Punkten für {face} wählen: {count} fehlen"
    ),
    "Place {count} points on {face}, then the others are proposed": (
        "{count} Punkte auf {face} setzen, dann werden die anderen vorgeschlagen"
    ),
    "Place one more point on {face}, then the others are proposed": (
        "Noch einen Punkt auf {face} setzen, dann werden die anderen vorgeschlagen"
    ),
    "Place {count} more points on {face}": "Noch {count} Punkte auf {face} setzen",
    "Place one more point on {face}": "Noch einen Punkt auf {face} setzen",
    "Go back to Object Mode": "Zurück in den Objektmodus",
    "Press Retarget": "Auf Übertragen drücken",
    "Examples are optional: press Retarget": "Beispiele sind freiwillig: auf Übertragen drücken",
    "Play it: then export it, or correct it and retarget again": (
        "Abspielen: dann exportieren, oder verbessern und neu übertragen"
    ),
    # Long work.
    "Esc stops": "Esc hält an",
    "{seconds} s left": "noch {seconds} s",
    "{minutes} min left": "noch {minutes} min",
    "Stopped: nothing was changed": "Angehalten: nichts wurde geändert",
    "Working": "Arbeitet",
    "Retargeting": "Überträgt",
    "Guessing": "Rät",
    "Fitting": "Passt an",
    "Comparing": "Vergleicht",
    "Loading the job": "Lädt den Auftrag",
    "Loading the shapes": "Lädt die Formen",
    "Saving the shapes": "Speichert die Formen",
    "Building": "Baut",
    "Saving the job": "Speichert den Auftrag",
    "Making controls": "Erstellt Regler",
    "Cloning": "Klont",
    "Solving": "Löst neu",
    "Making the actor": "Erstellt den Darsteller",
    "Making the faces": "Erstellt die Gesichter",
    "Roughing out": "Legt an",
    "Mirroring": "Spiegelt",
    "Checking examples": "Prüft Beispiele",
    "Taking the frame apart": "Zerlegt das Bild",
    "Copying points": "Kopiert Punkte",
    "Making normal maps": "Erstellt Normalmaps",
    "Importing": "Importiert",
    "Exporting": "Exportiert",
    "Making shapes": "Erstellt Formen",
}
