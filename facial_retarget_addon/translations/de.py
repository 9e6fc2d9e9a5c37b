"""German. What has no entry stays English."""

TEXTS = {
    # The line on top.
    "Import two faces, or try the built-in ones": "Zwei Gesichter importieren, oder die eingebauten ausprobieren",
    "Choose the face that moves": "Das Gesicht wählen, das sich bewegt",
    "Choose the face that shall move": "Das Gesicht wählen, das sich bewegen soll",
    "{face} is not in this scene: choose another face": "{face} ist nicht in dieser Szene: ein anderes Gesicht wählen",
    "Source and target are one object: choose another target": (
        "Quelle und Ziel sind dasselbe Objekt: ein anderes Ziel wählen"
    ),
    "Unhide {face}: Blender moves nothing hidden": "{face} einblenden: Verborgenes bewegt Blender nicht",
    "{face} does not move: animate it, or choose another source": (
        "{face} bewegt sich nicht: animieren, oder eine andere Quelle wählen"
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
    # Its buttons.
    "Add Built-In Faces": "Eingebaute Gesichter hinzufügen",
    "Use Active Object": "Aktives Objekt nehmen",
    "Place Points": "Punkte setzen",
    "Retarget": "Übertragen",
    "Set Up Workspace": "Arbeitsbereich einrichten",
    "Export glTF": "glTF exportieren",
    "Export Curves": "Kurven exportieren",
    "Export FAPs": "FAPs exportieren",
    "Open Manual": "Handbuch öffnen",
    # The panels.
    "1. Faces": "1. Gesichter",
    "2. Feature Points": "2. Merkmalspunkte",
    "3. Examples": "3. Beispiele",
    "4. Retarget": "4. Übertragen",
    "5. Bake and Export": "5. Backen und Exportieren",
    "6. Report": "6. Bericht",
    "More": "Weiteres",
    "Base Mesh": "Grundnetz",
    "Parts of the Head": "Teile des Kopfes",
    "Show in View": "In der Ansicht zeigen",
    "Settings": "Einstellungen",
    "Gains": "Stärken",
    "Live Preview": "Live-Vorschau",
    "Compare": "Vergleichen",
    "Normal Maps": "Normalenkarten",
    "Job for the Command Line": "Auftrag für die Kommandozeile",
    "Clone Shape Keys": "Shape-Keys klonen",
    "Corrections": "Verbesserungen",
    "MPEG-4 Face": "MPEG-4-Gesicht",
    # Long work.
    "Retargeting": "Überträgt",
    "Esc stops": "Esc hält an",
    "Stop": "Anhalten",
    "{seconds} s left": "noch {seconds} s",
    "{minutes} min left": "noch {minutes} min",
    "Stopped: nothing was changed": "Angehalten: nichts wurde geändert",
    "Wait for what is being computed, or stop it with Esc": "Abwarten, was gerechnet wird, oder mit Esc anhalten",
    "Choose a source and a target under Faces": "Quelle und Ziel unter Gesichter wählen",
    "The target has no shape keys: bake the performance as some": (
        "Das Ziel hat keine Shape-Keys: die Darbietung als solche backen"
    ),
    "No FAPs drive the target: Export Motion, under MPEG-4 Face, measures them on its mesh": (
        "Keine FAPs treiben das Ziel an: Export Motion, unter MPEG-4-Gesicht, misst sie am Netz"
    ),
    "Switch to Object Mode": "In den Objektmodus wechseln",
}
"""English text -> German text, with the same {fields}."""
