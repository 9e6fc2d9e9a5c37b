"""What panels, lists, the tool's header, the status bar and the view say beside buttons and properties."""

TEXTS = {
    # Titles.
    "Facial Retarget": "Facial Retarget",
    "Next": "Als Nächstes",
    "1. Faces": "1. Gesichter",
    "2. Feature Points": "2. Merkmalspunkte",
    "3. Examples": "3. Beispiele",
    "4. Retarget": "4. Übertragen",
    "5. Bake and Export": "5. Backen und Exportieren",
    "6. Report": "6. Bericht",
    "More": "Weiteres",
    "Base Mesh": "Basismasche",
    "Parts of the Head": "Teile des Kopfes",
    "Show in View": "In der Ansicht zeigen",
    "Settings": "Einstellungen",
    "Gains": "Stärken",
    "Bake": "Backen",
    "Normal Maps": "Normalmaps",
    "Job for the Command Line": "Auftrag für die Kommandozeile",
    "Corrections": "Verbesserungen",
    "MPEG-4 Face": "MPEG-4-Gesicht",
    # Faces and points.
    "At": "Bei",
    "Select a face": "Ein Gesicht auswählen",
    "{placed} of {wanted} placed": "{placed} von {wanted} gesetzt",
    "{placed} of {wanted} placed, and {others} others": "{placed} von {wanted} gesetzt, und {others} andere",
    "The mesh has changed since the points were placed": "Die Masche hat sich geändert, seit die Punkte gesetzt wurden",
    "Doubtful: {why}": "Zweifelhaft: {why}",
    "Load": "Laden",
    "Save": "Speichern",
    "Own Base": "Eigene Basis",
    # The tool.
    "Feature Points": "Merkmalspunkte",
    "Click on the active face to place the point whose turn it is.\nDrag a point along the surface, Ctrl-click "
    "removes it": (
        "Auf das aktive Gesicht klicken, um den Punkt zu setzen, der an der Reihe ist.\n"
        "Einen Punkt über die Oberfläche ziehen; Strg-Klick entfernt ihn"
    ),
    "X": "X",
    "All points of the set are placed or skipped": "Alle Punkte des Satzes sind gesetzt oder übersprungen",
    "Next: {label} – {meaning}": "Als Nächstes: {label} – {meaning}",
    "Feature Point Names": "Namen der Merkmalspunkte",
    "Place": "Setzen",
    "Slide": "Verschieben",
    "Remove": "Entfernen",
    "Skip": "Überspringen",
    "Go Back": "Zurück",
    "Accept": "Annehmen",
    # Over the view.
    "{label} (proposed)": "{label} (vorgeschlagen)",
    "{placed} of {wanted}": "{placed} von {wanted}",
    "Stretch, times the neutral length": "Dehnung, mal die Länge in Ruhe",
    "Stretch beyond the source's, times": "Dehnung über die der Quelle hinaus, mal",
    "Difference from the source's motion, of the head's size": (
        "Abweichung von der Bewegung der Quelle, in Teilen der Kopfgröße"
    ),
    "largest {value}": "größte {value}",
    # Examples.
    "Neutral: the Basis of both faces": "Neutral: die Basis beider Gesichter",
    "Neutral: the source's frame, the target's Basis": "Neutral: ein Bild der Quelle, die Basis des Ziels",
    "{example} on {face}": "{example} auf {face}",
    "Rough Out All on Target": "Alle auf dem Ziel anlegen",
    "Met but for {fit:.1%} of its motion": "Getroffen bis auf {fit:.1%} seiner Bewegung",
    "Met but for {fit:.1%} of its motion; without it {share:.0%} would be missing": (
        "Getroffen bis auf {fit:.1%} seiner Bewegung; ohne es würden {share:.0%} fehlen"
    ),
    "Sculpt": "Formen",
    # Retargeting, its preview and its bake.
    "Plays: {kind}": "Spielt: {kind}",
    "Frames": "Bilder",
    "to": "bis",
    "{size:.0f} MB on disk": "{size:.0f} MB auf der Platte",
    "At most {size:.0f} MB in the file": "Höchstens {size:.0f} MB in der Datei",
    "For so much, Compact Shape Keys or a cache fit better": (
        "Für so viel eignen sich kompakte Schlüssel oder ein Zwischenspeicher besser"
    ),
    "{milliseconds:.1f} ms a frame": "{milliseconds:.1f} ms je Bild",
    "Torn": "Riss",
    "Folds": "Falte",
    "Fit s": "Fit s",
    "ms": "ms",
    "Regions": "Bereiche",
    "Painted Masks": "Gemalte Masken",
    # The report.
    "Retarget or clone first": "Erst übertragen oder klonen",
    "Worst": "Schlimmste",
    "Turn": "Dreh",
    "Lip": "Lippe",
    "Lid": "Lid",
    # More.
    "Copy": "Kopieren",
    "Select a head with cloned shape keys": "Einen geklonten Kopf auswählen",
    "Make Shapes": "Formen erstellen",
    "Load Shapes": "Formen laden",
    "Save Shapes": "Formen speichern",
    "Jaw and Inner Lips": "Kiefer und innere Lippen",
    "Outer Lips": "Äußere Lippen",
    "Ears": "Ohren",
}
