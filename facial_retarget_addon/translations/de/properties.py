"""What is set on objects and scenes: names, choices and tooltips."""

_ROLES = {
    "left eyeball": ("Linker Augapfel", "der linke Augapfel"),
    "right eyeball": ("Rechter Augapfel", "der rechte Augapfel"),
    "upper teeth": ("Obere Zähne", "die oberen Zähne"),
    "lower teeth": ("Untere Zähne", "die unteren Zähne"),
    "gums": ("Zahnfleisch", "das Zahnfleisch"),
    "tongue": ("Zunge", "die Zunge"),
    "lashes": ("Wimpern", "die Wimpern"),
    "brows": ("Brauen", "die Brauen"),
    "moustache": ("Schnurrbart", "der Schnurrbart"),
    "beard": ("Bart", "der Bart"),
}
"""Part of a head -> its name, and the same in a sentence."""

TEXTS = {
    # Source and target.
    "Source": "Quelle",
    "Target": "Ziel",
    "The face that moves": "Das Gesicht, das sich bewegt",
    "The face that shall move": "Das Gesicht, das sich bewegen soll",
    "Neutral": "Neutral",
    "How the source looks at rest": "Wie die Quelle in Ruhe aussieht",
    "Basis": "Basis",
    "The source's neutral is its Basis, without modifiers": "Neutral ist die Basis der Quelle, ohne Modifikatoren",
    "Frame": "Bild",
    "The source's neutral is how it looks at one frame: for caches and scans": (
        "Neutral ist die Quelle, wie sie in einem Bild aussieht: für Zwischenspeicher und Scans"
    ),
    "Neutral Frame": "Neutrales Bild",
    "Scene frame at which the source is at rest": "Bild der Szene, in dem die Quelle in Ruhe ist",
    "Scene Range": "Bereich der Szene",
    "Retarget the scene's frame range": "Den Bildbereich der Szene übertragen",
    "First Frame": "Erstes Bild",
    "Last Frame": "Letztes Bild",
    "First scene frame that is retargeted": "Erstes Bild der Szene, das übertragen wird",
    "Last scene frame that is retargeted": "Letztes Bild der Szene, das übertragen wird",
    "Role": "Rolle",
    "Face": "Gesicht",
    "Head": "Kopf",
    "The empty that shows how the head turns": "Das leere Objekt, das zeigt, wie der Kopf sich dreht",
    # Feature points.
    "Title": "Titel",
    "Its name, and what a person calls it": "Sein Name, und wie man ihn nennt",
    "Meaning": "Bedeutung",
    "Where on a face it lies": "Wo auf einem Gesicht er liegt",
    "Vertices": "Eckpunkte",
    "The vertices that hold the point": "Die Eckpunkte, die den Punkt halten",
    "Weights": "Gewichte",
    "How much of each vertex": "Wie viel von jedem Eckpunkt",
    "Topology": "Topologie",
    "The topology on which these vertices count, empty if it was never noted": (
        "Die Topologie, für die diese Eckpunkte gelten; leer, wenn sie nie notiert wurde"
    ),
    "Anchored": "Verankert",
    "The anchor says where the point is when the topology changes": (
        "Der Anker sagt, wo der Punkt ist, wenn die Topologie sich ändert"
    ),
    "Anchor": "Anker",
    "Its place on the mesh at rest": "Seine Stelle auf der Masche in Ruhe",
    "Anchor Normal": "Normale des Ankers",
    "The surface's normal there": "Die Normale der Oberfläche dort",
    "Doubt": "Zweifel",
    "Why the point may be in the wrong place; empty if it is not": (
        "Warum der Punkt an der falschen Stelle sein könnte; leer, wenn nicht"
    ),
    "Active Feature Point": "Aktiver Merkmalspunkt",
    "The feature point that is chosen in the list": "Der Merkmalspunkt, der in der Liste gewählt ist",
    "Active Proposal": "Aktiver Vorschlag",
    "The proposal that is chosen in the list": "Der Vorschlag, der in der Liste gewählt ist",
    "Active Skipped Point": "Aktiver übersprungener Punkt",
    "The skipped point that is chosen in the list": "Der übersprungene Punkt, der in der Liste gewählt ist",
    "List": "Liste",
    "Which feature points the list shows": "Welche Merkmalspunkte die Liste zeigt",
    "Placed": "Gesetzt",
    "Feature points that the face has": "Merkmalspunkte, die das Gesicht hat",
    "Proposed": "Vorschläge",
    "Feature points that are predicted, and count once they are accepted": (
        "Merkmalspunkte, die vorhergesagt sind und zählen, sobald sie angenommen werden"
    ),
    "Skipped": "Ausgelassen",
    "Feature points of the set that this face does without": (
        "Merkmalspunkte des Satzes, ohne die dieses Gesicht auskommt"
    ),
    "Mesh Has Changed": "Masche hat sich geändert",
    "Vertices were added, removed or renumbered since the feature points were placed": (
        "Eckpunkte sind hinzugekommen, entfernt oder umnummeriert worden, seit die Merkmalspunkte gesetzt wurden"
    ),
    "Set": "Satz",
    "Which feature points the face shall have": "Welche Merkmalspunkte das Gesicht haben soll",
    "Minimal": "Minimal",
    "15 points: the least from which a face can be driven": (
        "15 Punkte: die wenigsten, mit denen sich ein Gesicht bewegen lässt"
    ),
    "MPEG-4": "MPEG-4",
    "48 points of the MPEG-4 standard: all that motion cloning and FAPs need on the skin": (
        "48 Punkte des MPEG-4-Standards: alles, was Motion Cloning und FAPs auf der Haut brauchen"
    ),
    "Dense": "Dicht",
    "124 points: those of MPEG-4 and more between them, for the hierarchical method's base mesh": (
        "124 Punkte: die von MPEG-4 und weitere dazwischen, für die Basismasche der hierarchischen Methode"
    ),
    "X Mirror": "X-Spiegelung",
    "What you do with a point happens to its partner on the other half of the face too": (
        "Was mit einem Punkt geschieht, geschieht auch mit seinem Partner auf der anderen Hälfte des Gesichts"
    ),
    "A base mesh of your own: show the base mesh, change its triangles, choose it here": (
        "Eine eigene Basismasche: die Basismasche zeigen, ihre Dreiecke ändern, hier wählen"
    ),
    # Parts of the head.
    "Object": "Objekt",
    "The object that is a part of the head": "Das Objekt, das ein Teil des Kopfes ist",
    "What the part is, and so how it moves": "Was der Teil ist, und damit, wie er sich bewegt",
    "By Place": "Nach der Lage",
    "What it is shows by where it lies on the head": "Was er ist, zeigt sich daran, wo er am Kopf liegt",
    "Still": "Starr",
    "Never moves": "Bewegt sich nie",
    "Active Part": "Aktiver Teil",
    "The part of the head that is chosen in the list": "Der Teil des Kopfes, der in der Liste gewählt ist",
    # Over the view.
    "Points": "Punkte",
    "Show the feature points of source, target and the active face; names appear under the mouse": (
        "Die Merkmalspunkte von Quelle, Ziel und aktivem Gesicht zeigen; Namen erscheinen unter der Maus"
    ),
    "All Names": "Alle Namen",
    "Show the names of all points that face the view": "Die Namen aller Punkte zeigen, die der Ansicht zugewandt sind",
    "Show the triangles between the points on source and target; those that fold over stand out": (
        "Die Dreiecke zwischen den Punkten auf Quelle und Ziel zeigen; die umklappen, fallen auf"
    ),
    "Heat Map": "Wärmebild",
    "Show a figure of each vertex of the target as colour": "Eine Zahl zu jedem Eckpunkt des Ziels als Farbe zeigen",
    "Figure": "Zahl",
    "What the colours of the heat map show": "Was die Farben des Wärmebilds zeigen",
    "Stretch": "Dehnung",
    "How many times its neutral length the most stretched edge at a vertex has": (
        "Das Wievielfache ihrer neutralen Länge die am meisten gedehnte Kante an einem Eckpunkt hat"
    ),
    "Beyond the Source": "Mehr als die Quelle",
    "Stretch over the source's at the same place; needs a retargeting": (
        "Dehnung gegen die der Quelle an derselben Stelle; braucht eine Übertragung"
    ),
    "Motion Difference": "Bewegungsabweichung",
    "How far a vertex is from where the source's motion, turned and scaled as the heads are, would take it; a method "
    "that fits other proportions differs on purpose. Needs a retargeting": (
        "Wie weit ein Eckpunkt von dort weg ist, wohin ihn die Bewegung der Quelle brächte, gedreht und skaliert wie "
        "die Köpfe; eine Methode, die andere Proportionen berücksichtigt, weicht mit Absicht ab. Braucht eine "
        "Übertragung"
    ),
    "Diagram": "Schaubild",
    "While the feature-point tool is chosen, show in a corner of the view where the next point lies": (
        "Solange das Werkzeug für Merkmalspunkte gewählt ist, in einer Ecke der Ansicht zeigen, wo der nächste Punkt "
        "liegt"
    ),
    # Examples.
    "Example": "Beispiel",
    "On the Source": "Auf der Quelle",
    "On the Target": "Auf dem Ziel",
    "How far the example is there": "Wie weit das Beispiel dort ist",
    "Missing": "Fehlt",
    "The face has no shape key of this name": "Das Gesicht hat keinen Formschlüssel dieses Namens",
    "Not Sculpted": "Nicht geformt",
    "The shape key equals the Basis: the example is left out": (
        "Der Formschlüssel gleicht der Basis: das Beispiel bleibt weg"
    ),
    "Sculpted": "Geformt",
    "The shape key moves the face": "Der Formschlüssel bewegt das Gesicht",
    "Warning": "Warnung",
    "What is wrong with the example": "Was mit dem Beispiel nicht stimmt",
    "Fit": "Passung",
    "Share of the example's motion that the method misses; -1 if not checked": (
        "Anteil der Bewegung des Beispiels, den die Methode verfehlt; -1, wenn nicht geprüft"
    ),
    "Without It": "Ohne es",
    "Share of the example's motion that would be missing if only the others were known": (
        "Anteil der Bewegung des Beispiels, der fehlen würde, wären nur die anderen bekannt"
    ),
    "Checked": "Geprüft",
    "Whether its figures are those of the examples as they are now": (
        "Ob seine Zahlen die der Beispiele sind, wie sie jetzt sind"
    ),
    "Tells the examples that the figures belong to": "Sagt, zu welchen Beispielen die Zahlen gehören",
    "Active Example": "Aktives Beispiel",
    "The example that is chosen in the list": "Das Beispiel, das in der Liste gewählt ist",
    "The object in Sculpt Mode": "Das Objekt im Skulpturmodus",
    "Its name": "Sein Name",
    "SOURCE or TARGET": "SOURCE oder TARGET",
    "Active Object": "Aktives Objekt",
    "The object that was active before": "Das Objekt, das vorher aktiv war",
    "The shape key that was active before": "Der Formschlüssel, der vorher aktiv war",
    "Pinned": "Geheftet",
    "Whether it alone was shown before": "Ob er vorher allein gezeigt wurde",
    # Methods and what makes the motion weaker or stronger.
    "Method": "Methode",
    "How the motion is carried from face to face": "Wie die Bewegung von Gesicht zu Gesicht gebracht wird",
    "Methods": "Methoden",
    "The methods that are compared": "Die Methoden, die verglichen werden",
    "How many frames of the range the figures come from": "Aus wie vielen Bildern des Bereichs die Zahlen stammen",
    "A vertex group of the target": "Eine Punktgruppe des Ziels",
    "Vertex Group": "Punktgruppe",
    "Gain": "Stärke",
    "Strength of the motion where the weight is 1; where it is 0, nothing changes": (
        "Stärke der Bewegung, wo das Gewicht 1 ist; wo es 0 ist, ändert sich nichts"
    ),
    "Active Mask": "Aktive Maske",
    "The mask that is chosen in the list": "Die Maske, die in der Liste gewählt ist",
    # Bakes.
    "Bake As": "Backen als",
    "What the frames become on the target": "Was die Bilder auf dem Ziel werden",
    "Shape Keys": "Formschlüssel",
    "A shape key per frame, each shown on its own frame: to edit and to mix": (
        "Ein Formschlüssel je Bild, jeder in seinem Bild gezeigt: zum Bearbeiten und Mischen"
    ),
    "Absolute Shape Keys": "Absolute Schlüssel",
    "A shape key per frame, all on one curve: plays many times as fast": (
        "Ein Formschlüssel je Bild, alle auf einer Kurve: spielt um ein Vielfaches schneller"
    ),
    "Compact Shape Keys": "Kompakte Schlüssel",
    "As few shape keys as the tolerance allows, each a region, with curves to edit": (
        "So wenige Formschlüssel, wie die Toleranz erlaubt, jeder ein Bereich, mit bearbeitbaren Kurven"
    ),
    "Own Shape Keys": "Eigene Schlüssel",
    "Curves of the shape keys that the target has: your own sliders": (
        "Kurven der Formschlüssel, die das Ziel hat: die eigenen Regler"
    ),
    "PC2 Cache": "PC2-Datei",
    "A file on disk that a Mesh Cache modifier plays: for long performances": (
        "Eine Datei auf der Platte, die ein Mesh-Cache-Modifikator abspielt: für lange Darbietungen"
    ),
    "MDD Cache": "MDD-Datei",
    "The same, as older programs read it": "Dasselbe, wie ältere Programme es lesen",
    "Alembic Cache": "Alembic-Datei",
    "One file of all moved objects that other programs read, and a modifier that plays it": (
        "Eine Datei aller bewegten Objekte, die andere Programme lesen, und ein Modifikator, der sie abspielt"
    ),
    "USD Cache": "USD-Datei",
    "The same as USD: .usdc, or .usd if you name it so": "Dasselbe als USD: .usdc, oder .usd, wenn die Datei so heißt",
    "Step": "Schritt",
    "Scene frames from one baked frame to the next; below 1 for sub-frames": (
        "Bilder der Szene von einem gebackenen Bild zum nächsten; unter 1 für Zwischenbilder"
    ),
    "Names": "Namen",
    "Names of the shape keys of frames: the frame's number stands in place of the #": (
        "Namen der Formschlüssel der Bilder: die Nummer des Bildes steht anstelle der #"
    ),
    "Cache": "Zwischenspeicher",
    "File that the cache becomes": "Datei, die der Zwischenspeicher wird",
    "Earlier Bake": "Früheres",
    "What becomes of the bake that the target plays now": "Was aus dem wird, was das Ziel jetzt abspielt",
    "Its shape keys, curves and modifiers go": "Seine Formschlüssel, Kurven und Modifikatoren gehen",
    "It stays, turned off: play it again below. A cache gets a file of its own": (
        "Es bleibt, abgeschaltet: unten wieder abspielen. Ein Zwischenspeicher bekommt eine eigene Datei"
    ),
    "Earlier bakes that are kept": "Früher Gebackenes, das behalten wird",
    "Name of the earlier bake": "Name des früher Gebackenen",
    "What the earlier bake is called on every object of the head": (
        "Wie das früher Gebackene auf jedem Objekt des Kopfes heißt"
    ),
    "What the frames became": "Was aus den Bildern wurde",
    "Names of its shape keys while it plays": "Namen seiner Formschlüssel, während es spielt",
    "Kept Shape Keys": "Behaltene Formschlüssel",
    "Kept Action": "Behaltene Aktion",
    "Kept Slot": "Behaltener Slot",
    "Kept Modifier": "Behaltener Modifikator",
    "Names of the same shape keys now, muted": "Namen derselben Formschlüssel jetzt, stumm geschaltet",
    "Names of the object's own shape keys that it moves": "Namen der eigenen Formschlüssel des Objekts, die es bewegt",
    "Its curves while it does not play": "Seine Kurven, während es nicht spielt",
    "The slot of the action that has the object's curves": "Der Slot der Aktion, der die Kurven des Objekts hat",
    "Name of the modifier that plays its cache, turned off": (
        "Name des Modifikators, der seinen Zwischenspeicher abspielt, abgeschaltet"
    ),
    "The kind of the bake that the face plays; empty for none": (
        "Die Art des Backens, die das Gesicht abspielt; leer für keine"
    ),
    # Normal maps.
    "For": "Für",
    "The mesh that the maps are for": "Die Masche, für die die Maps sind",
    "The target's own mesh, with its active UV map": "Die eigene Masche des Ziels, mit ihrer aktiven UV-Map",
    "Level": "Stufe",
    "A coarse level of the target's normal mesh, which becomes an object with its own UVs": (
        "Eine grobe Stufe der Normalenmasche des Ziels, die ein Objekt mit eigenen UVs wird"
    ),
    "Level that the maps are for: 1 is coarsest": "Stufe, für die die Maps sind: 1 ist die gröbste",
    "Size": "Größe",
    "Pixels along each side of a map": "Pixel entlang jeder Seite einer Map",
    "Margin": "Rand",
    "Pixels that the map goes on past the borders of the UVs": (
        "Pixel, die die Map über die Ränder der UVs hinausreicht"
    ),
    "Depth": "Tiefe",
    "What a picture file holds": "Was eine Bilddatei enthält",
    "PNG, 16 Bits": "PNG, 16 Bit",
    "Fine enough for smooth skin": "Fein genug für glatte Haut",
    "PNG, 8 Bits": "PNG, 8 Bit",
    "Small files, as games use them": "Kleine Dateien, wie Spiele sie benutzen",
    "OpenEXR": "OpenEXR",
    "Floats, as they were computed": "Gleitkommazahlen, wie sie berechnet wurden",
    "Green": "Grün",
    "Which way green points in the pictures": "Wohin Grün in den Bildern zeigt",
    "Up (OpenGL)": "Hoch (OpenGL)",
    "As Blender and OpenGL have it": "Wie Blender und OpenGL es halten",
    "Down (DirectX)": "Herunter (DirectX)",
    "As DirectX has it": "Wie DirectX es hält",
    "Folder": "Ordner",
    "Folder that the maps become; it is replaced": "Ordner, der die Maps aufnimmt; er wird ersetzt",
    "Show in Materials": "In Materialien zeigen",
    "Let the materials' Principled shaders show the maps": (
        "Die Principled-Shader der Materialien die Maps zeigen lassen"
    ),
    # Files.
    "Report": "Bericht",
    "Where to write the figures (.json)": "Wohin die Zahlen geschrieben werden (.json)",
    "Page": "Seite",
    "Where to write the page to look at (.html)": "Wohin die Seite zum Ansehen geschrieben wird (.html)",
    "Where the command line writes the frames of a saved job": (
        "Wohin die Kommandozeile die Bilder eines gespeicherten Auftrags schreibt"
    ),
    # Shape keys from head to head.
    "Name": "Name",
    "From": "Von",
    "Whose shape keys are cloned": "Wessen Formschlüssel geklont werden",
    "The shape keys of the source chosen under Faces, and of its parts": (
        "Die Formschlüssel der Quelle, die unter Gesichter gewählt ist, und ihrer Teile"
    ),
    "Built-In Actor": "Eingebauter Darsteller",
    "The shapes of the built-in actor; no source is needed, and nothing is added": (
        "Die Formen des eingebauten Darstellers; es braucht keine Quelle, und nichts wird hinzugefügt"
    ),
    "Sets": "Sätze",
    "Which of the actor's shapes": "Welche Formen des Darstellers",
    "ARKit": "ARKit",
    "The 52 shapes that phones record": "Die 52 Formen, die Telefone aufzeichnen",
    "Visemes": "Viseme",
    "The mouth in speech: MPEG-4's 14": "Der Mund beim Sprechen: die 14 von MPEG-4",
    "Expressions": "Mimik",
    "joy, sadness, anger, fear, disgust, surprise": (
        "joy, sadness, anger, fear, disgust, surprise (Freude, Trauer, Wut, Angst, Ekel, Überraschung)"
    ),
    "Onto": "Auf",
    "Which heads get the shape keys": "Welche Köpfe die Formschlüssel bekommen",
    "The target chosen under Faces": "Das Ziel, das unter Gesichter gewählt ist",
    "Selected Heads": "Ausgewählte Köpfe",
    "Every selected object with feature points, but for the source": (
        "Jedes ausgewählte Objekt mit Merkmalspunkten, außer der Quelle"
    ),
    "Keep": "Behalten",
    "Which shape keys: patterns such as mouth* or *Left, with commas between": (
        "Welche Formschlüssel: Muster wie mouth* oder *Left, mit Kommas dazwischen"
    ),
    "But Not": "Aber nicht",
    "Which of these to leave out, as patterns with commas between": (
        "Welche davon wegbleiben, als Muster mit Kommas dazwischen"
    ),
    "Sides": "Seiten",
    "What becomes of shape keys with and without a side in their name": (
        "Was aus Formschlüsseln mit und ohne Seite im Namen wird"
    ),
    "As They Are": "Wie sie sind",
    "Shape keys come as the source has them": "Formschlüssel kommen, wie die Quelle sie hat",
    "Split": "Teilen",
    "Shape keys without a side in their name become a left and a right one": (
        "Formschlüssel ohne Seite im Namen werden ein linker und ein rechter"
    ),
    "Merge": "Vereinen",
    "Left and right halves of what ARKit has as a whole become one": (
        "Linke und rechte Hälften von dem, was ARKit als Ganzes hat, werden eins"
    ),
    "Soft Border": "Weiche Grenze",
    "How far left and right overlap on either side of the middle, in distances between the eyes": (
        "Wie weit links und rechts sich beiderseits der Mitte überlappen, in Augenabständen"
    ),
    "ARKit Names": "ARKit-Namen",
    "Shape keys that stand for one of ARKit's get its name: eyeBlink_L, EyeBlinkLeft": (
        "Formschlüssel, die für einen von ARKit stehen, bekommen dessen Namen: eyeBlink_L, EyeBlinkLeft"
    ),
    "Existing Keys": "Vorhandene",
    "What becomes of shape keys that are there already": "Was aus Formschlüsseln wird, die es schon gibt",
    "Shape keys of these names that move something stay as they are": (
        "Formschlüssel dieser Namen, die etwas bewegen, bleiben, wie sie sind"
    ),
    "Replace": "Ersetzen",
    "Shape keys of these names are made anew": "Formschlüssel dieser Namen werden neu erstellt",
    "Number": "Nummer",
    "New shape keys whose name is taken get a number behind it": (
        "Neue Formschlüssel, deren Name vergeben ist, bekommen eine Nummer dahinter"
    ),
    "Drivers": "Treiber",
    "Copy the drivers of the shape keys": "Die Treiber der Formschlüssel kopieren",
    "Animation": "Animation",
    "Copy the animation of the shape keys": "Die Animation der Formschlüssel kopieren",
    "Side": "Seite",
    "Which half of the source's shape key it is": "Welche Hälfte des Formschlüssels der Quelle es ist",
    "Whole": "Ganz",
    "Both sides": "Beide Seiten",
    "Left Half": "Linke Hälfte",
    "The left side alone": "Die linke Seite allein",
    "Right Half": "Rechte Hälfte",
    "The right side alone": "Die rechte Seite allein",
    "Corrected": "Verbessert",
    "As you want it: Re-solve leaves it alone, and teaches the other keys by it": (
        "Wie er sein soll: Neu lösen lässt ihn in Ruhe und lehrt die anderen Schlüssel nach ihm"
    ),
    "Shape": "Form",
    "Fingerprint of the shape that was cloned, by which a change shows": (
        "Fingerabdruck der geklonten Form, an dem sich eine Änderung zeigt"
    ),
    "Figures": "Zahlen",
    "What the report says of it": "Was der Bericht davon sagt",
    "Active Cloned Shape Key": "Aktiver geklonter Formschlüssel",
    "The cloned shape key that is chosen in the list": "Der geklonte Formschlüssel, der in der Liste gewählt ist",
    # What a retargeting or cloning found.
    "Kind": "Art",
    "What is in trouble": "Was fehlerhaft ist",
    "A baked frame": "Ein gebackenes Bild",
    "Shape Key": "Formschlüssel",
    "A cloned shape key": "Ein geklonter Formschlüssel",
    "The scene frame": "Das Bild der Szene",
    "What is wrong, in words": "Was nicht stimmt, in Worten",
    "Trouble": "Fehler",
    "All figures together, by which the worst come first": "Alle Zahlen zusammen, damit das Schlimmste vorn steht",
    "Torn Edges": "Gerissene Kanten",
    "Edges stretched beyond 3 times where the source is calm": (
        "Kanten, die auf mehr als das Dreifache gedehnt sind, wo die Quelle ruhig ist"
    ),
    "Turned Triangles": "Umgedrehte Dreiecke",
    "Triangles that look inwards where the source's do not": (
        "Dreiecke, die nach innen sehen, wo die der Quelle es nicht tun"
    ),
    "Lip Gap": "Lippenspalt",
    "More than the source's, in percent of the mouth's width": "Mehr als bei der Quelle, in Prozent der Mundbreite",
    "Lid Gap": "Lidspalt",
    "More than the source's, in percent of the eye's opening": "Mehr als bei der Quelle, in Prozent der Augenöffnung",
    "Torn Vertices": "Gerissene Eckpunkte",
    "Vertices of the torn edges, packed": "Eckpunkte der gerissenen Kanten, gepackt",
    "Turned Vertices": "Umgedrehte Eckpunkte",
    "Vertices of the turned triangles, packed": "Eckpunkte der umgedrehten Dreiecke, gepackt",
    "Lip Vertices": "Eckpunkte der Lippen",
    "Vertices of lips that gape, packed": "Eckpunkte klaffender Lippen, gepackt",
    "Lid Vertices": "Eckpunkte der Lider",
    "Vertices of lids that gape, packed": "Eckpunkte klaffender Lider, gepackt",
    "Active Finding": "Aktiver Befund",
    "Click to go to the frame, or to set the shape key to 1": (
        "Klicken, um zum Bild zu gehen oder den Formschlüssel auf 1 zu setzen"
    ),
    "Findings": "Befunde",
    "What was found, in words": "Was gefunden wurde, in Worten",
    "Vertices Then": "Eckpunkte damals",
    "How many vertices the object had when this was found": (
        "Wie viele Eckpunkte das Objekt hatte, als das gefunden wurde"
    ),
    "Source Then": "Quelle damals",
    "The source of the baked frames": "Die Quelle der gebackenen Bilder",
    "Counterpart": "Gegenstück",
    "The source's vertex for each of the head's vertices, packed": (
        "Der Eckpunkt der Quelle zu jedem Eckpunkt des Kopfes, gepackt"
    ),
    "Shown Shape Key": "Gezeigter Formschlüssel",
    "The shape key that a click in the list has set to 1": (
        "Der Formschlüssel, den ein Klick in der Liste auf 1 gesetzt hat"
    ),
    # Long work.
    "Running": "Läuft",
    "Whether something is being computed": "Ob etwas gerechnet wird",
    "Whether the artist has asked to stop": "Ob angehalten werden soll",
    "Doing": "Tätigkeit",
    "What is being computed": "Was gerechnet wird",
    "Share": "Anteil",
    "How much of it is done": "Wie viel davon getan ist",
    "Left": "Rest",
    "Seconds that it still takes, 0 where that is not known": (
        "Sekunden, die es noch dauert; 0, wo das nicht bekannt ist"
    ),
}
TEXTS |= {role.title(): name for role, (name, _) in _ROLES.items()}
TEXTS |= {f"Moves as {role} do": f"Bewegt sich wie {spoken}" for role, (_, spoken) in _ROLES.items()}
