"""Operators: what buttons and their tooltips say, what can be set in them, and why they cannot run."""

TEXTS = {
    # Faces.
    "Add Built-In Faces": "Eingebaute Gesichter hinzufügen",
    "Add the built-in actor with a performance, and beside it a face that shall get it; Esc stops": (
        "Den eingebauten Darsteller mit einer Darbietung hinzufügen, und daneben ein Gesicht, das sie bekommen soll; "
        "Esc hält an"
    ),
    "The face that shall get the performance": "Das Gesicht, das die Darbietung bekommen soll",
    "Child": "Kind",
    "Large eyes and a small mouth, 8 000 vertices": "Große Augen und ein kleiner Mund, 8 000 Eckpunkte",
    "Ape": "Affe",
    "A muzzle and heavy brows, 24 000 vertices": "Eine Schnauze und schwere Brauen, 24 000 Eckpunkte",
    "Skull": "Schädel",
    "Hollow cheeks and wide sockets, 20 000 vertices": "Hohle Wangen und weite Augenhöhlen, 20 000 Eckpunkte",
    "With Points": "Mit Punkten",
    "Both faces have their feature points already": "Beide Gesichter haben ihre Merkmalspunkte schon",
    "Add Built-In Actor": "Eingebauten Darsteller hinzufügen",
    "Add the built-in actor with its shape keys and feature points, and make it the source; Esc stops": (
        "Den eingebauten Darsteller mit seinen Formschlüsseln und Merkmalspunkten hinzufügen und zur Quelle machen; "
        "Esc hält an"
    ),
    "Use Active Object": "Aktives Objekt nehmen",
    "Make the active object the face that moves, or the face that shall move": (
        "Das aktive Objekt zu dem Gesicht machen, das sich bewegt, oder zu dem, das sich bewegen soll"
    ),
    "Which of the two faces the active object becomes": "Welches der beiden Gesichter das aktive Objekt wird",
    "Set Up Workspace": "Arbeitsbereich einrichten",
    "Show source and target side by side in a workspace of their own, each from the front; deleting it undoes this": (
        "Quelle und Ziel nebeneinander in einem eigenen Arbeitsbereich zeigen, beide von vorn; ihn zu löschen nimmt "
        "das zurück"
    ),
    "Workspaces need a window": "Arbeitsbereiche brauchen ein Fenster",
    "Open Manual": "Handbuch öffnen",
    "Open this step's page of the manual, which ships with the extension, in the browser": (
        "Die Seite dieses Schritts im Handbuch, das der Erweiterung beiliegt, im Browser öffnen"
    ),
    "Which page, and which place on it": "Welche Seite, und welche Stelle darauf",
    "The manual is part of the built extension, not of its sources": (
        "Das Handbuch gehört zur gebauten Erweiterung, nicht zu ihren Quellen"
    ),
    "Stop": "Anhalten",
    "Stop what is being computed; nothing is changed then": ("Anhalten, was gerechnet wird; dann wird nichts geändert"),
    "Nothing is being computed": "Es wird nichts gerechnet",
    # When most of them cannot run.
    "Wait for what is being computed, or stop it with Esc": "Abwarten, was gerechnet wird, oder mit Esc anhalten",
    "Switch to Object Mode": "In den Objektmodus wechseln",
    "Leave Edit Mode": "Den Bearbeitungsmodus verlassen",
    "Select a mesh object: the source or the target face": (
        "Ein Maschenobjekt auswählen: das Quell- oder das Zielgesicht"
    ),
    "Choose a source and a target under Faces": "Quelle und Ziel unter Gesichter wählen",
    "Choose a target under Faces": "Ein Ziel unter Gesichter wählen",
    "Give the face feature points with MPEG-4 names first": ("Dem Gesicht erst Merkmalspunkte mit MPEG-4-Namen geben"),
    # Feature points.
    "Place Points": "Punkte setzen",
    "Make the source or the target the active object, and choose the feature-point tool": (
        "Quelle oder Ziel zum aktiven Objekt machen und das Werkzeug für Merkmalspunkte wählen"
    ),
    "Which of the two faces gets points": "Welches der beiden Gesichter Punkte bekommt",
    "Points are placed in a 3D view": "Punkte werden in einer 3D-Ansicht gesetzt",
    "Place Feature Point": "Merkmalspunkt setzen",
    "Place the feature point whose turn it is, or slide the one under the mouse along the surface": (
        "Den Merkmalspunkt setzen, der an der Reihe ist, oder den unter der Maus über die Oberfläche verschieben"
    ),
    "The point to place; the one whose turn it is if none is named": (
        "Der Punkt, der gesetzt wird; ohne Namen der, der an der Reihe ist"
    ),
    "Location": "Position",
    "Where the surface is closest to it, in world space": "Wo ihm die Oberfläche am nächsten ist, im Weltraum",
    "Accept Hovered Point": "Punkt unter der Maus annehmen",
    "Place the proposed feature point under the mouse where it is proposed, or else the one whose turn it is": (
        "Den vorgeschlagenen Merkmalspunkt unter der Maus setzen, wo er vorgeschlagen ist, sonst den, der an der "
        "Reihe ist"
    ),
    "The proposed point; the one whose turn it is if none is named": (
        "Der vorgeschlagene Punkt; ohne Namen der, der an der Reihe ist"
    ),
    "Remove Hovered Point": "Punkt unter der Maus entfernen",
    "Remove the feature point under the mouse": "Den Merkmalspunkt unter der Maus entfernen",
    "The point to remove": "Der Punkt, der entfernt wird",
    "Skip Feature Point": "Merkmalspunkt überspringen",
    "Skip the feature point whose turn it is, or go back to the one that was skipped last": (
        "Den Merkmalspunkt überspringen, der an der Reihe ist, oder zum zuletzt übersprungenen zurückgehen"
    ),
    "Back": "Zurück",
    "Go back to the point that was skipped last": "Zum zuletzt übersprungenen Punkt zurückgehen",
    "Add Feature Point": "Merkmalspunkt hinzufügen",
    "Add a named feature point to the active face": "Dem aktiven Gesicht einen benannten Merkmalspunkt hinzufügen",
    "Its MPEG-4 number, such as 2.1, or a name of your own": "Seine MPEG-4-Nummer, etwa 2.1, oder ein eigener Name",
    "Where the point is put": "Wohin der Punkt kommt",
    "3D Cursor": "3D-Cursor",
    "Where the surface is closest to the 3D cursor": "Wo die Oberfläche dem 3D-Cursor am nächsten ist",
    "Selected Vertex": "Ausgewählter Eckpunkt",
    "On the one vertex that is selected": "Auf den einen Eckpunkt, der ausgewählt ist",
    "Remove Feature Point": "Merkmalspunkt entfernen",
    "Remove the chosen feature point from the active face": "Den gewählten Merkmalspunkt vom aktiven Gesicht entfernen",
    "Choose a feature point in the list": "Einen Merkmalspunkt in der Liste wählen",
    "Guess Points": "Punkte raten",
    "Propose all missing feature points: by those that are placed, or by the shape of the head alone; Esc stops": (
        "Alle fehlenden Merkmalspunkte vorschlagen: nach denen, die gesetzt sind, oder allein nach der Form des "
        "Kopfes; Esc hält an"
    ),
    "Accept Point": "Punkt annehmen",
    "Place one proposed feature point where it is proposed": (
        "Einen vorgeschlagenen Merkmalspunkt setzen, wo er vorgeschlagen ist"
    ),
    "The proposed point; empty for the one that is chosen in the list": (
        "Der vorgeschlagene Punkt; leer für den, der in der Liste gewählt ist"
    ),
    "Accept All": "Alle annehmen",
    "Place all proposed feature points where they are proposed": (
        "Alle vorgeschlagenen Merkmalspunkte setzen, wo sie vorgeschlagen sind"
    ),
    "Clear Proposals": "Vorschläge verwerfen",
    "Forget all proposed feature points; those that are placed stay": (
        "Alle vorgeschlagenen Merkmalspunkte vergessen; die gesetzten bleiben"
    ),
    "No points are proposed: place a few, or press Guess Points": (
        "Keine Punkte sind vorgeschlagen: einige setzen, oder auf Punkte raten drücken"
    ),
    "Want Point": "Punkt doch wollen",
    "Take back that the face does without this feature point": (
        "Zurücknehmen, dass das Gesicht ohne diesen Merkmalspunkt auskommt"
    ),
    "The skipped point": "Der übersprungene Punkt",
    "Mirror Points": "Punkte spiegeln",
    "Place the partners of feature points on the other half of the face, through its surface": (
        "Die Partner von Merkmalspunkten auf die andere Hälfte des Gesichts setzen, über seine Oberfläche"
    ),
    "Which points are mirrored; their partners are moved if they are placed": (
        "Welche Punkte gespiegelt werden; ihre Partner werden verschoben, wenn sie gesetzt sind"
    ),
    "From the half that is the subject's left to the other one": "Von der linken Hälfte der Person zur anderen",
    "From the half that is the subject's right to the other one": "Von der rechten Hälfte der Person zur anderen",
    "Chosen Point": "Gewählter Punkt",
    "From the point that is chosen in the list to its partner": (
        "Von dem Punkt, der in der Liste gewählt ist, zu seinem Partner"
    ),
    "Copy Points to Selected": "Punkte auf Ausgewählte kopieren",
    "Copy the feature points of the active face to the other selected ones: exactly, or by a fit of other topology": (
        "Die Merkmalspunkte des aktiven Gesichts auf die anderen ausgewählten kopieren: genau, oder bei anderer "
        "Topologie durch Anpassung"
    ),
    "The active object has no feature points to copy": "Das aktive Objekt hat keine Merkmalspunkte zum Kopieren",
    "Select the faces that shall get the points, and the one that has them last": (
        "Die Gesichter auswählen, die die Punkte bekommen sollen, und als letztes das, das sie hat"
    ),
    "Load Feature Points": "Merkmalspunkte laden",
    "Replace the feature points of the active face by those of a file": (
        "Die Merkmalspunkte des aktiven Gesichts durch die einer Datei ersetzen"
    ),
    "Save Feature Points": "Merkmalspunkte speichern",
    "Save the feature points of the active face to a file; what is only proposed is left out": (
        "Die Merkmalspunkte des aktiven Gesichts in einer Datei speichern; nur Vorgeschlagenes bleibt weg"
    ),
    "The face has no feature points": "Das Gesicht hat keine Merkmalspunkte",
    "Refresh Points": "Punkte erneuern",
    "Put the feature points back onto a mesh that was cut or merged, and say which ones lost their surface": (
        "Die Merkmalspunkte auf eine geschnittene oder verschmolzene Masche zurücksetzen und sagen, welche ihre "
        "Oberfläche verloren haben"
    ),
    "Show Base Mesh": "Basismasche zeigen",
    "Build the base mesh from the feature points and show it on both faces, as wire objects; Esc stops": (
        "Die Basismasche aus den Merkmalspunkten bauen und auf beiden Gesichtern zeigen, als Drahtobjekte; Esc hält an"
    ),
    "Add Selected Parts": "Ausgewählte Teile hinzufügen",
    "List the selected objects as parts of the active face's head: eyes, teeth, tongue, lashes, brows": (
        "Die ausgewählten Objekte als Teile des Kopfes des aktiven Gesichts führen: Augen, Zähne, Zunge, Wimpern, "
        "Brauen"
    ),
    "Remove Part": "Teil entfernen",
    "Take the chosen part off the list; its object stays": (
        "Den gewählten Teil von der Liste nehmen; sein Objekt bleibt"
    ),
    "Choose a part in the list": "Einen Teil in der Liste wählen",
    # Examples.
    "Create Example Shape Keys": "Beispiel-Formschlüssel erstellen",
    "Give both faces the shape keys of the seven examples: the Basis is the neutral one, the others wait for you": (
        "Beiden Gesichtern die Formschlüssel der sieben Beispiele geben: die Basis ist das neutrale, die anderen "
        "warten darauf, geformt zu werden"
    ),
    "Add Example": "Beispiel hinzufügen",
    "Use a shape key that both faces have as an example": (
        "Einen Formschlüssel, den beide Gesichter haben, als Beispiel nehmen"
    ),
    "Its name on source and target": "Sein Name auf Quelle und Ziel",
    "Remove Example": "Beispiel entfernen",
    "Take the chosen example off the list; its shape keys stay": (
        "Das gewählte Beispiel von der Liste nehmen; seine Formschlüssel bleiben"
    ),
    "Choose an example in the list": "Ein Beispiel in der Liste wählen",
    "Sculpt Example": "Beispiel formen",
    "Sculpt this example: Sculpt Mode on its shape key, which alone is shown; Done brings back what was before": (
        "Dieses Beispiel formen: Skulpturmodus auf seinem Formschlüssel, der allein gezeigt wird; Fertig stellt "
        "wieder her, was vorher war"
    ),
    "Its name; the chosen one of the list if empty": "Sein Name; leer das in der Liste gewählte",
    "Sculpt {example} on {face}: Sculpt Mode on its shape key, which alone is shown; Done brings back what was "
    "before": (
        "{example} auf {face} formen: Skulpturmodus auf dem Formschlüssel, der allein gezeigt wird; Fertig stellt "
        "wieder her, was vorher war"
    ),
    "Which face is sculpted": "Welches Gesicht geformt wird",
    "Done": "Fertig",
    "Leave Sculpt Mode, and bring back what was before: the active object, its active shape key, and the pin": (
        "Den Skulpturmodus verlassen und wiederherstellen, was vorher war: aktives Objekt, aktiver Formschlüssel und "
        "seine Heftung"
    ),
    "No example is being sculpted": "Es wird kein Beispiel geformt",
    "Rough Out": "Anlegen",
    "Make examples to sculpt on, out of the face's feature points or as the other face shows them; Esc stops": (
        "Beispiele zum Weiterformen anlegen, aus den Merkmalspunkten des Gesichts oder so, wie das andere Gesicht sie "
        "zeigt; Esc hält an"
    ),
    "What the examples are made from": "Woraus die Beispiele entstehen",
    "Out of the face's own MPEG-4 feature points": "Aus den eigenen MPEG-4-Merkmalspunkten des Gesichts",
    "Other Face": "Anderes Gesicht",
    "As the other face shows it, by the method that clones shape keys": (
        "Wie das andere Gesicht es zeigt, nach der Methode, die Formschlüssel klont"
    ),
    "Existing": "Vorhandene",
    "What becomes of examples that are sculpted already": "Was aus Beispielen wird, die schon geformt sind",
    "Examples that are sculpted stay as they are": "Geformte Beispiele bleiben, wie sie sind",
    "Examples that are sculpted are made anew": "Geformte Beispiele werden neu angelegt",
    "Replace what you have sculpted?": "Das Geformte ersetzen?",
    "Its name; all of the list if empty": "Sein Name; leer alle der Liste",
    "Which face's example it is": "Zu welchem Gesicht das Beispiel gehört",
    "Mirror": "Spiegeln",
    "Mirror this example through the surface: meshes that are not symmetric too; Esc stops": (
        "Dieses Beispiel über die Oberfläche spiegeln: auch bei unsymmetrischen Maschen; Esc hält an"
    ),
    "Way": "Weise",
    "Which half becomes what": "Welche Hälfte was wird",
    "Left to Right": "Links nach rechts",
    "The right half shows what the face's left half does": "Die rechte Hälfte zeigt, was die linke des Gesichts tut",
    "Right to Left": "Rechts nach links",
    "The left half shows what the face's right half does": "Die linke Hälfte zeigt, was die rechte des Gesichts tut",
    "Mean of Both": "Mittel aus beiden",
    "Both halves show the mean of what they do": "Beide Hälften zeigen das Mittel dessen, was sie tun",
    "Flip": "Vertauschen",
    "The halves exchange what they do": "Die Hälften tauschen, was sie tun",
    "Strength": "Stärke",
    "Make this example stronger or weaker": "Dieses Beispiel stärker oder schwächer machen",
    "By how much its motion is multiplied": "Womit seine Bewegung malgenommen wird",
    "Check Examples": "Beispiele prüfen",
    "See how well the method meets each example, and how well the others foretell it; Esc stops": (
        "Sehen, wie gut die Methode jedes Beispiel trifft und wie gut die anderen es vorhersagen; Esc hält an"
    ),
    # Retargeting.
    "Retarget": "Übertragen",
    "Retarget the source's performance and bake it on the target as one shape key per frame; Esc stops": (
        "Die Darbietung der Quelle auf das Ziel übertragen und als einen Formschlüssel je Bild backen; Esc hält an"
    ),
    "Live Preview": "Live-Vorschau",
    "Fit the method, and let the target follow while you scrub, play, or drag sliders of the source; Esc stops": (
        "Die Methode anpassen und das Ziel folgen lassen, während man die Zeit verschiebt, abspielt oder Regler der "
        "Quelle zieht; Esc hält an"
    ),
    "Turn the preview off: the target is as it was before, and no file holds anything of it": (
        "Die Vorschau ausschalten: das Ziel ist, wie es vorher war, und keine Datei enthält etwas davon"
    ),
    "The live preview is off": "Die Live-Vorschau ist aus",
    "Compare": "Vergleichen",
    "Fit the chosen methods, measure each on some frames, and let the target follow by the one you pick; Esc stops": (
        "Die gewählten Methoden anpassen, jede an einigen Bildern messen und das Ziel nach der folgen lassen, die man "
        "anklickt; Esc hält an"
    ),
    "Show Method": "Methode zeigen",
    "Choose this method: the target follows by it at once": "Diese Methode wählen: das Ziel folgt ihr sofort",
    "The method to choose": "Die Methode, die gewählt wird",
    "Show Levels": "Stufen zeigen",
    "Show beside the target what each level adds at the current frame: one slider per level; Esc stops": (
        "Neben dem Ziel zeigen, was jede Stufe beim aktuellen Bild hinzufügt: ein Regler je Stufe; Esc hält an"
    ),
    "Add Mask": "Maske hinzufügen",
    "Let a vertex group of the target make the motion weaker or stronger; one is made if there is none to take": (
        "Eine Punktgruppe des Ziels die Bewegung schwächer oder stärker machen lassen; gibt es keine, wird eine "
        "erstellt"
    ),
    "Remove Mask": "Maske entfernen",
    "Take the mask off the list; its vertex group stays": "Die Maske von der Liste nehmen; ihre Punktgruppe bleibt",
    "There is no mask": "Es gibt keine Maske",
    "Select": "Auswählen",
    "Select the vertices of the chosen frame's or shape key's trouble, in Edit Mode": (
        "Die Eckpunkte auswählen, die am gewählten Bild oder Formschlüssel fehlerhaft sind, im Bearbeitungsmodus"
    ),
    "Which of the vertices": "Welche der Eckpunkte",
    "Vertices of the torn edges": "Eckpunkte der gerissenen Kanten",
    "Vertices of the triangles that are turned over": "Eckpunkte der umgedrehten Dreiecke",
    "Choose a frame or a shape key in the report's list": (
        "Ein Bild oder einen Formschlüssel in der Liste des Berichts wählen"
    ),
    "The target follows the source": "Das Ziel folgt der Quelle",
    "Click a method to see the target follow by it": "Auf eine Methode klicken, um das Ziel ihr folgen zu sehen",
    "Lips": "Lippe",
    "Edges of the lips, where they are open wider than the source's": (
        "Ränder der Lippen, wo sie weiter offen sind als die der Quelle"
    ),
    "Lids": "Lid",
    "Edges of the lids, where they are open wider than the source's": (
        "Ränder der Lider, wo sie weiter offen sind als die der Quelle"
    ),
    # Out of Blender.
    "Export glTF": "glTF exportieren",
    "Export the target and the parts of its head with their shape keys and animation, by Blender's glTF exporter": (
        "Das Ziel und die Teile seines Kopfes mit Formschlüsseln und Animation exportieren, mit Blenders glTF-Exporter"
    ),
    "Enable the add-on glTF 2.0 Format in the preferences": (
        "Das Add-on „glTF 2.0 format“ in den Einstellungen einschalten"
    ),
    "Export Curves": "Kurvenexport",
    "Export the curves of the target's shape keys as a table or a document, frame by frame; Esc stops": (
        "Die Kurven der Formschlüssel des Ziels als Tabelle oder Dokument exportieren, Bild für Bild; Esc hält an"
    ),
    "Table (.csv)": "Tabelle (.csv)",
    "A line for each frame and a column for each shape key, as spreadsheets read it": (
        "Eine Zeile je Bild und eine Spalte je Formschlüssel, wie Tabellenprogramme es lesen"
    ),
    "Document (.json)": "Dokument (.json)",
    "A list of values for each shape key, with the frames and their rate": (
        "Eine Liste von Werten je Formschlüssel, mit den Bildern und ihrer Rate"
    ),
    "Scene frames from one exported frame to the next; below 1 for sub-frames": (
        "Bilder der Szene von einem exportierten Bild zum nächsten; unter 1 für Zwischenbilder"
    ),
    "The target has no bake": "Das Ziel hat nichts Gebackenes",
    "Play Bake": "Gebackenes abspielen",
    "Play this earlier bake again; the one that plays now is kept, and a live preview ends": (
        "Dieses früher Gebackene wieder abspielen; was jetzt spielt, bleibt erhalten, und eine Live-Vorschau endet"
    ),
    "Remove Bake": "Gebackenes entfernen",
    "Remove this bake: its shape keys, curves and modifiers; files of a cache stay, and other bakes": (
        "Dieses Gebackene entfernen: seine Formschlüssel, Kurven und Modifikatoren; Dateien eines Zwischenspeichers "
        "bleiben, und anderes Gebackenes"
    ),
    "Which kept bake; 0 for the one that plays": "Welches behaltene Gebackene; 0 für das, was spielt",
    "The target has no shape keys: bake the performance as some": (
        "Das Ziel hat keine Formschlüssel: die Darbietung als solche backen"
    ),
    "Export FAPs": "FAP-Export",
    "Export the MPEG-4 FAPs that drive the target, as its controls stand frame by frame; Esc stops": (
        "Die MPEG-4-FAPs exportieren, die das Ziel bewegen, wie seine Regler Bild für Bild stehen; Esc hält an"
    ),
    "No FAPs drive the target: Export Motion, under MPEG-4 Face, measures them on its mesh": (
        "Keine FAPs bewegen das Ziel: Motion-Export, unter MPEG-4-Gesicht, misst sie an der Masche"
    ),
    "Make Normal Maps": "Normalmaps erstellen",
    "Make a normal map of each frame, which gives a light mesh the wrinkles of the finest level; Esc stops": (
        "Von jedem Bild eine Normalmap erstellen, die einer leichten Masche die Falten der feinsten Stufe gibt; Esc "
        "hält an"
    ),
    "Choose a folder for the maps": "Einen Ordner für die Maps wählen",
    "Load Job": "Auftrag laden",
    "Load a job file: its faces become objects, its settings the panel's; Esc stops": (
        "Eine Auftragsdatei laden: ihre Gesichter werden Objekte, ihre Einstellungen die des Panels; Esc hält an"
    ),
    "Up": "Oben",
    "Which way is up in the job's files": "Welche Richtung in den Dateien des Auftrags oben ist",
    "Y": "Y",
    "The files' faces stand along Y": "Die Gesichter der Dateien stehen entlang Y",
    "Z": "Z",
    "The files' faces stand along Z": "Die Gesichter der Dateien stehen entlang Z",
    "Save Job": "Auftrag speichern",
    "Save the task as a job file, with the faces, frames and points that it needs beside it; Esc stops": (
        "Die Aufgabe als Auftragsdatei speichern, mit den Gesichtern, Bildern und Punkten, die sie braucht; Esc hält an"
    ),
    "Save Clone Job": "Klonauftrag speichern",
    "Save the cloning as a job for the command line, with all heads, shapes and corrections beside it; Esc stops": (
        "Das Klonen als Auftrag für die Kommandozeile speichern, mit allen Köpfen, Formen und Verbesserungen daneben; "
        "Esc hält an"
    ),
    # Shape keys from head to head.
    "Clone Shape Keys": "Formschlüssel klonen",
    "Give one or several heads the shape keys of another, all objects of the head in one go; Esc stops": (
        "Einem oder mehreren Köpfen die Formschlüssel eines anderen geben, allen Objekten des Kopfes auf einmal; Esc "
        "hält an"
    ),
    "Mark Changed Keys": "Geänderte Schlüssel markieren",
    "Mark the cloned shape keys that you have changed as corrected; Re-solve does it by itself too": (
        "Die geklonten Formschlüssel, die geändert wurden, als verbessert markieren; Neu lösen tut das auch von selbst"
    ),
    "Re-Solve": "Neu lösen",
    "Solve the cloned shape keys again from those that you have corrected, which stay as they are; Esc stops": (
        "Die geklonten Formschlüssel neu lösen, ausgehend von den verbesserten, die bleiben, wie sie sind; Esc hält an"
    ),
    "Choose a source under Faces, or clone from the built-in actor": (
        "Eine Quelle unter Gesichter wählen, oder vom eingebauten Darsteller klonen"
    ),
    "Choose a target under Faces, or clone onto the selected heads": (
        "Ein Ziel unter Gesichter wählen, oder auf die ausgewählten Köpfe klonen"
    ),
    "Select the heads that shall get the shapes": "Die Köpfe auswählen, die die Formen bekommen sollen",
    # The MPEG-4 face.
    "Make Expression Shapes": "Ausdrucksformen erstellen",
    "Give the active face shape keys out of its MPEG-4 feature points, to be sculpted further; Esc stops": (
        "Dem aktiven Gesicht Formschlüssel aus seinen MPEG-4-Merkmalspunkten geben, zum Weiterformen; Esc hält an"
    ),
    "Which of the standard's shapes": "Welche Formen des Standards",
    "joy, sadness, anger, fear, disgust, surprise: the examples too": (
        "joy, sadness, anger, fear, disgust, surprise (Freude, Trauer, Wut, Angst, Ekel, Überraschung): auch die "
        "Beispiele"
    ),
    "FAPs": "FAPs",
    "One for each of MPEG-4's low-level parameters": "Eine für jeden einzelnen Parameter von MPEG-4",
    "Load Shape Keys": "Formschlüssel laden",
    "Give the active face and its parts the shapes of a facial animation table (.json) or arrays (.npz); Esc stops": (
        "Dem aktiven Gesicht und seinen Teilen die Formen einer Gesichtsanimationstabelle (.json) oder von Arrays "
        "(.npz) geben; Esc hält an"
    ),
    "Save Shape Keys": "Formschlüssel speichern",
    "Save the shape keys of the active face and its parts: an animation table (.json) or arrays (.npz); Esc stops": (
        "Die Formschlüssel des aktiven Gesichts und seiner Teile speichern: als Animationstabelle (.json) oder Arrays "
        "(.npz); Esc hält an"
    ),
    "Controls made": "Regler erstellt",
    "Make FAP Controls": "FAP-Regler erstellen",
    "Give the active face a slider for each FAP: shape keys and drivers that work without this extension": (
        "Dem aktiven Gesicht einen Regler für jeden FAP geben: Formschlüssel und Treiber, die ohne diese Erweiterung "
        "arbeiten"
    ),
    "Remove FAP Controls": "FAP-Regler entfernen",
    "Remove the FAP controls of the active face: sliders, their animation, drivers and shape keys": (
        "Die FAP-Regler des aktiven Gesichts entfernen: Regler, ihre Animation, Treiber und Formschlüssel"
    ),
    "Import Motion": "Motion-Import",
    "Import FAPs, ARKit weights or optical markers onto the active face; Esc stops": (
        "FAPs, ARKit-Gewichte oder optische Marker auf das aktive Gesicht importieren; Esc hält an"
    ),
    "As": "Als",
    "What the motion becomes on the face": "Was die Bewegung auf dem Gesicht wird",
    "Controls or Named Shapes": "Regler oder benannte Formen",
    "FAPs and markers as FAP controls, ARKit as its 52 shape keys": (
        "FAPs und Marker als FAP-Regler, ARKit als seine 52 Formschlüssel"
    ),
    "Three shape keys per point: any length of motion, and still editable": (
        "Drei Formschlüssel je Punkt: für Bewegung jeder Länge, und trotzdem bearbeitbar"
    ),
    "One shape key per frame, as a retargeted performance": (
        "Ein Formschlüssel je Bild, wie eine übertragene Darbietung"
    ),
    "Start Frame": "Startbild",
    "Scene frame of the file's first frame": "Bild der Szene für das erste Bild der Datei",
    "What becomes of the motion of the head as a whole": "Was aus der Bewegung des Kopfes als Ganzes wird",
    "Leave": "Weglassen",
    "The head does not turn": "Der Kopf dreht sich nicht",
    "Empty": "Leer",
    "An empty turns as the head turns: parent the head to it, or let a bone copy it": (
        "Ein leeres Objekt dreht sich wie der Kopf: den Kopf daran hängen, oder einen Knochen es kopieren lassen"
    ),
    "Unused FAPs": "Unbenutzte FAPs",
    "What becomes of a FAP at frames that do not use it": "Was aus einem FAP in Bildern wird, die ihn nicht benutzen",
    "Hold": "Halten",
    "A FAP that a frame does not use stays as it was": "Ein FAP, den ein Bild nicht benutzt, bleibt, wie er war",
    "Zero": "Null",
    "A FAP that a frame does not use is 0": "Ein FAP, den ein Bild nicht benutzt, ist 0",
    "Hidden Markers": "Verdeckte Marker",
    "What becomes of markers that the cameras have lost for a while": (
        "Was aus Markern wird, die die Kameras eine Weile verloren haben"
    ),
    "Fill": "Füllen",
    "Short gaps are filled with smooth curves": "Kurze Lücken werden mit glatten Kurven gefüllt",
    "Refuse": "Ablehnen",
    "Markers with gaps are not imported": "Marker mit Lücken werden nicht importiert",
    "Marker Map": "Markerzuordnung",
    "Which marker sits on which point (.json); without it the markers' names say so": (
        "Welcher Marker auf welchem Punkt sitzt (.json); ohne sie sagen es die Namen der Marker"
    ),
    "Rate": "Rate",
    "Frames a second of a table that does not tell them, or 0": (
        "Bilder je Sekunde einer Tabelle, die sie nicht angibt, sonst 0"
    ),
    "Update Scene FPS": "Bildrate der Szene anpassen",
    "The scene takes over the file's rate": "Die Szene übernimmt die Bildrate der Datei",
    "Update Scene Duration": "Dauer der Szene anpassen",
    "The scene's range becomes that of the motion": "Der Bildbereich der Szene wird der der Bewegung",
    "Export Motion": "Motion-Export",
    "Export the motion of the active face at the scene's rate; Esc stops": (
        "Die Bewegung des aktiven Gesichts in der Bildrate der Szene exportieren; Esc hält an"
    ),
    "Format": "Format",
    "In a script the file's suffix decides": "In einem Skript entscheidet die Endung der Datei",
    "MPEG-4 FAPs (.fap)": "MPEG-4-FAPs (.fap)",
    "From the FAP controls, or measured on the mesh": "Aus den FAP-Reglern, oder an der Masche gemessen",
    "ARKit (.csv)": "ARKit (.csv)",
    "From the shape keys with ARKit's names, as Live Link Face writes it": (
        "Aus den Formschlüsseln mit den Namen von ARKit, wie Live Link Face es schreibt"
    ),
    "First scene frame that is exported": "Erstes Bild der Szene, das exportiert wird",
    "Last scene frame that is exported": "Letztes Bild der Szene, das exportiert wird",
    "FAPs From": "FAPs aus",
    "Where the values are read from": "Woher die Werte gelesen werden",
    "Controls or Mesh": "Reglern oder Masche",
    "The FAP controls if the face has them, its feature points otherwise": (
        "Aus den FAP-Reglern, wenn das Gesicht sie hat, sonst aus seinen Merkmalspunkten"
    ),
    "Mesh": "Masche",
    "The feature points as the mesh moves, even if there are controls": (
        "Die Merkmalspunkte, wie die Masche sich bewegt, auch wenn es Regler gibt"
    ),
    "Mesh with a Moving Head": "Masche mit bewegtem Kopf",
    "The same where the head moves in the mesh itself, as in a cache": (
        "Dasselbe, wo der Kopf sich in der Masche selbst bewegt, wie in einem Zwischenspeicher"
    ),
}
