"""Sentences of reports: what was done, what is wrong. What {} stands for says `translations.sentences`.

Those of the core and of files stand beside it. What only programs get to read, such as the shapes of arrays, stays
English, as on the command line.
"""

SENTENCES = {
    # What operators have done.
    "{} is the source, with {} shapes": "{} ist die Quelle, mit {} Formen",
    "Added {}, who acts, and {}, the target": "Hinzugefügt: {}, der spielt, und {}, das Ziel",
    "{} is the {} already: select another object": "{} ist schon als {:said} gewählt: ein anderes Objekt auswählen",
    "{} shape keys cloned{}": "{} Formschlüssel geklont{:said}",
    "{} kept": "{} behalten",
    "{} shape keys are corrected": "{} Formschlüssel sind verbessert",
    "{} shape keys solved again, from {} corrected ones": "{} Formschlüssel neu gelöst, aus {} verbesserten",
    "{}: {} feature points copied {}": "{}: {} Merkmalspunkte {:said} kopiert",
    "{} FAPs have no points on this face: {}": "{} FAPs haben auf diesem Gesicht keine Punkte: {}",
    "{} parts added": "{} Teile hinzugefügt",
    "Loaded {}": "{} geladen",
    "Saved {}": "{} gespeichert",
    "example {} is listed already, expected another shape key's name": (
        "Beispiel {} steht schon auf der Liste; den Namen eines anderen Formschlüssels angeben"
    ),
    "Roughed out: {}": "Angelegt: {}",
    "Mirrored: {}": "Gespiegelt: {}",
    "{}: there is nothing to make it from, sculpt it": "{}: es gibt nichts, woraus es entstehen könnte; bitte formen",
    "{} is sculpted on {} already": "{} ist auf {} schon geformt",
    "{} shapes made, {} kept": "{} Formen erstellt, {} behalten",
    "{} shapes have no points on this face and stay empty: {}": (
        "{} Formen haben auf diesem Gesicht keine Punkte und bleiben leer: {}"
    ),
    "{} frames imported, up to scene frame {}": "{} Bilder importiert, bis Bild {} der Szene",
    "{} frames exported from {}": "{} Bilder exportiert; Quelle: {:said}",
    "Normal maps of {} in {}": "Normalmaps von {} in {}",
    "{} feature points on {}": "{} Merkmalspunkte auf {}",
    "{} feature points saved": "{} Merkmalspunkte gespeichert",
    "{} points mirrored": "{} Punkte gespiegelt",
    "{} feature points accepted": "{} Merkmalspunkte angenommen",
    "{} points proposed, but {} hardly looks like a face": (
        "{} Punkte vorgeschlagen, aber {} sieht kaum wie ein Gesicht aus"
    ),
    "{} points proposed: move what is wrong, then accept them": (
        "{} Punkte vorgeschlagen: verschieben, was nicht stimmt, dann annehmen"
    ),
    "{}: {} points": "{}: {} Punkte",
    "{} moved with the surface ({}{})": "{} sind mit der Oberfläche gewandert ({}{})",
    "only proposed now, as the surface is gone: {}": "nur noch vorgeschlagen, weil die Oberfläche fehlt: {}",
    "all are where they were": "alle sind, wo sie waren",
    "Sculpting {} on {}": "{} wird auf {} geformt",
    "{} vertices selected": "{} Eckpunkte ausgewählt",
    "{} shape keys loaded, {} kept": "{} Formschlüssel geladen, {} behalten",
    "{} shape keys saved": "{} Formschlüssel gespeichert",
    "Base mesh of {} points and {} triangles": "Basismasche aus {} Punkten und {} Dreiecken",
    "This method has no levels; {} have": "Diese Methode hat keine Stufen; die mit Stufen: {}",
    "Levels: {}": "Stufen: {}",
    # What is being done.
    "Reading": "Liest",
    "Writing": "Schreibt",
    "Reading the faces": "Liest die Gesichter",
    "Reading frame {}": "Liest Bild {}",
    "Reading {}": "Liest {}",
    "Frame {} of {}": "Bild {} von {}",
    "frame {} of {}": "Bild {} von {}",
    "frame {} of {}{}": "Bild {} von {}{}",
    "Writing head {} of {}": "Schreibt Kopf {} von {}",
    "Building the base mesh": "Baut die Basismasche",
    "Preparing the bake": "Bereitet das Backen vor",
    "Waiting for what was stopped": "Wartet auf das, was angehalten wurde",
    "Drawing the page": "Zeichnet die Seite",
    "making the built-in actor": "erstellt den eingebauten Darsteller",
    "acting its shapes": "spielt seine Formen",
    "making the actor": "erstellt den Darsteller",
    "making the target": "erstellt das Ziel",
    "acting": "spielt",
    "fitting {} onto {}": "passt {} an {} an",
    "looking for a face on {}": "sucht ein Gesicht auf {}",
    "warping the target onto the source": "verformt das Ziel auf die Quelle",
    "bending the target onto the source": "biegt das Ziel auf die Quelle",
    "finding the places of the target's vertices on the source": "sucht die Stellen der Ziel-Eckpunkte auf der Quelle",
    "mending the map": "bessert die Zuordnung aus",
    "comparing both heads": "vergleicht beide Köpfe",
    "comparing left and right": "vergleicht links und rechts",
    "taking the frame apart": "zerlegt das Bild",
    "finding what each point moves": "sucht, was jeder Punkt bewegt",
    "placing the pixels": "setzt die Pixel",
    "normal map {} of {}": "Normalmap {} von {}",
    "looking for the wrinkles of {}": "sucht die Falten von {}",
    "preparing the motion": "bereitet die Bewegung vor",
    "making the wavelets": "erstellt die Wavelets",
    "making the base mesh": "erstellt die Basismasche",
    "piercing both faces": "durchstößt beide Gesichter",
    "measuring both faces": "misst beide Gesichter",
    "laying both faces in one plane": "legt beide Gesichter in eine Ebene",
    "learning from the examples": "lernt aus den Beispielen",
    "finding the components": "sucht die Bestandteile",
    "drawing the keys together": "zieht die Schlüssel zusammen",
    "fitting the curves": "passt die Kurven an",
    "fitted": "angepasst",
    "done": "fertig",
    # What is wrong with the faces and where they stand.
    "no {} is chosen, expected a mesh object under Faces": (
        "{0:said} ist nicht gewählt; ein Maschenobjekt unter Gesichter wählen"
    ),
    "no target is chosen, expected a mesh object under Faces": (
        "kein Ziel ist gewählt; ein Maschenobjekt unter Gesichter wählen"
    ),
    "no source is chosen, expected a mesh object under Faces, or the built-in actor": (
        "keine Quelle ist gewählt; ein Maschenobjekt unter Gesichter wählen, oder den eingebauten Darsteller"
    ),
    "source and target are both object {}, expected two objects": (
        "Quelle und Ziel sind beide Objekt {}; zwei Objekte wählen"
    ),
    "no mesh object is active: select the face first": "kein Maschenobjekt ist aktiv: erst das Gesicht auswählen",
    "object {} is linked from another file: make it local to give it points": (
        "Objekt {} ist aus einer anderen Datei verknüpft: lokal machen, um ihm Punkte zu geben"
    ),
    "object {} is linked from another file, expected one whose mesh can be changed": (
        "Objekt {} ist aus einer anderen Datei verknüpft; eines nehmen, dessen Masche sich ändern lässt"
    ),
    "object {} is hidden, expected it visible: Blender evaluates nothing hidden": (
        "Objekt {} ist verborgen; einblenden: Verborgenes wertet Blender nicht aus"
    ),
    "object {} is hidden, expected it visible to be sculpted": "Objekt {} ist verborgen; zum Formen einblenden",
    "object {} is hidden in renders, expected it visible: it is not evaluated": (
        "Objekt {} ist beim Rendern verborgen; einblenden: es wird nicht ausgewertet"
    ),
    "object {} is scaled to nothing along an axis, expected a scale that is not 0": (
        "Objekt {} ist entlang einer Achse auf nichts skaliert; die Skalierung darf nicht 0 sein"
    ),
    "object {} is listed as a part of its own head, expected other objects": (
        "Objekt {} steht als Teil seines eigenen Kopfes auf der Liste; andere Objekte nehmen"
    ),
    "object {} is listed twice as a part of {}, expected it once": (
        "Objekt {} steht zweimal als Teil von {} auf der Liste; einmal genügt"
    ),
    "shape key {} of object {} has vertices that are NaN": "Formschlüssel {} von Objekt {} hat Eckpunkte, die NaN sind",
    "the shape keys of object {} are absolute, expected relative ones": (
        "die Formschlüssel von Objekt {} sind absolut; relative werden gebraucht"
    ),
    "mesh {} is that of object {} and of object {}, expected a target with a mesh of its own, on one head": (
        "Masche {} gehört zu Objekt {} und zu Objekt {}; das Ziel braucht eine eigene Masche, an einem Kopf"
    ),
    "{} has {} vertices and no faces, expected a surface": (
        "{:said} hat {} Eckpunkte und keine Flächen; eine Oberfläche wird gebraucht"
    ),
    "{} has {} vertices and {} faces, expected a surface": (
        "{:said} hat {} Eckpunkte und {} Flächen; eine Oberfläche wird gebraucht"
    ),
    "object {} has {} vertices after its modifiers ({}), expected the {} of its mesh; turn off the modifier that adds "
    "or removes vertices": (
        "Objekt {0} hat nach seinen Modifikatoren ({2}) {1} Eckpunkte statt der {3} seiner Masche; den Modifikator "
        "ausschalten, der Eckpunkte hinzufügt oder entfernt"
    ),
    "mesh {} has faces that Blender cannot hold: doubled, or with a corner twice": (
        "Masche {} hat Flächen, die Blender nicht halten kann: doppelte, oder mit einer Ecke zweimal"
    ),
    "{} has {} vertices that are NaN or infinite, the first is vertex {}; expected finite positions": (
        "{:said} hat {} Eckpunkte, die NaN oder unendlich sind, der erste ist {}"
    ),
    "the frame range ends at {} before it starts at {}": "der Bildbereich endet bei {}, bevor er bei {} beginnt",
    # Bakes.
    "object {} keeps no earlier bake of number {}": "Objekt {} behält kein früheres Gebackenes mit der Nummer {}",
    "object {} plays no bake, expected one to remove": "Objekt {} spielt nichts Gebackenes, das man entfernen könnte",
    "shape key {} of {} is gone from object {}": "Formschlüssel {} von {} fehlt in Objekt {}",
    "modifier {} of {} is gone from object {}": "Modifikator {} von {} fehlt in Objekt {}",
    "frames of {} vertices arrived for object {}, expected its {}": (
        "Bilder mit {} Eckpunkten sind für Objekt {} angekommen; es hat {}"
    ),
    "object {} has shape keys of its own, {} among them, which absolute keys would turn off; expected another kind of "
    "bake": ("Objekt {} hat eigene Formschlüssel, darunter {}, die absolute abschalten würden; anders backen"),
    "object {} has no shape key that a bake onto its rig could animate, expected some that move a vertex, are not "
    "muted and have no driver": (
        "Objekt {} hat keinen Formschlüssel, den Backen auf sein Rig bewegen könnte: einen, der einen Eckpunkt "
        "bewegt, nicht stumm ist und keinen Treiber hat"
    ),
    "the pattern of names {} has no #, expected some where the frame's number goes": (
        "das Muster der Namen {} hat kein #; es steht, wo die Nummer des Bildes hingehört"
    ),
    "the pattern of names {} has a line break, expected a single line": (
        "das Muster der Namen {} hat einen Zeilenumbruch; es ist eine einzige Zeile"
    ),
    "UV map {} of object {} has a name of {} bytes, expected at most {}: materials cannot name it": (
        "UV-Map {} von Objekt {} hat einen Namen von {} Bytes; höchstens {} gehen: Materialien können sie nicht nennen"
    ),
    "object {} has a shape key {} of its own, which the bake would replace; expected another name": (
        "Objekt {} hat einen eigenen Formschlüssel {}, den das Backen ersetzen würde; anders nennen"
    ),
    "this Blender was built without {}, expected another kind of bake": (
        "dieses Blender wurde ohne {} gebaut; anders backen"
    ),
    "shape key {} has a name of {} bytes, expected at most {}": (
        "Formschlüssel {} hat einen Namen von {} Bytes; höchstens {} gehen"
    ),
    "no {} is chosen for the {}, expected one under {}": (
        "für {1:said} ist nichts gewählt ({0:said}); unter {2:said} wählen"
    ),
    "{} {} lies beside the .blend, which is not saved yet; save it, or name another": (
        "{:said} {} liegt neben der .blend-Datei, die noch nicht gespeichert ist; sie speichern, oder anderes nennen"
    ),
    # Motion in and out.
    "{} shape keys of object {} follow drivers, such as {}; expected keys that curves can move": (
        "{} Formschlüssel von Objekt {} folgen Treibern, etwa {}; gebraucht werden welche, die Kurven bewegen können"
    ),
    "object {} has no shape key, expected some whose curves could be exported": (
        "Objekt {} hat keinen Formschlüssel, dessen Kurven exportiert werden könnten"
    ),
    "object {} has no shape key with an ARKit name, expected some such as jawOpen": (
        "Objekt {} hat keinen Formschlüssel mit einem ARKit-Namen wie jawOpen"
    ),
    "object {} has no shape key with an ARKit name such as jawOpen, and no feature points to make one from": (
        "Objekt {} hat keinen Formschlüssel mit einem ARKit-Namen wie jawOpen, und keine Merkmalspunkte, um einen zu "
        "erstellen"
    ),
    "motion {} is a {}, expected .fap or .csv": "Bewegung {} ist {:said}; .fap oder .csv wird gebraucht",
    "FAP {} reaches {}, but controls end at {}: import the motion as points or frames": (
        "FAP {} reicht bis {}, aber Regler enden bei {}: die Bewegung als Punkte oder Bilder importieren"
    ),
    "ARKit shapes that the take uses and the face cannot show: {}": (
        "ARKit-Formen, die die Aufnahme benutzt und das Gesicht nicht zeigen kann: {}"
    ),
    "{} ARKit shapes have no shape key and are 0: {}": "{} ARKit-Formen haben keinen Formschlüssel und sind 0: {}",
    "{} turns about where the average face has its point 7.1: this face has none": (
        "{} dreht sich um die Stelle, an der das Durchschnittsgesicht seinen Punkt 7.1 hat: dieses Gesicht hat keinen"
    ),
    # Feature points.
    "All points of the set are placed or skipped: drag them, or choose a larger set": (
        "Alle Punkte des Satzes sind gesetzt oder übersprungen: sie ziehen, oder einen größeren Satz wählen"
    ),
    "all points of the set are placed on object {} or skipped, expected a name": (
        "alle Punkte des Satzes sind auf Objekt {} gesetzt oder übersprungen; einen Namen angeben"
    ),
    "all points of the set are placed on object {} or skipped already": (
        "alle Punkte des Satzes sind auf Objekt {} schon gesetzt oder übersprungen"
    ),
    "no point of object {} is skipped, expected one to go back to": (
        "kein Punkt von Objekt {} ist übersprungen, zu dem man zurückgehen könnte"
    ),
    "feature point {} of object {} is not proposed": "Merkmalspunkt {} von Objekt {} ist nicht vorgeschlagen",
    "object {} lacks no point of its set, expected one that is to be guessed": (
        "Objekt {} fehlt kein Punkt seines Satzes, der zu raten wäre"
    ),
    "object {} has no feature point to mirror among {}, expected one that has a partner on the other half of the "
    "face": (
        "Objekt {} hat unter {:said} keinen Merkmalspunkt zum Spiegeln: einen mit einem Partner auf der anderen "
        "Hälfte des Gesichts"
    ),
    "no proposed point of object {} is chosen, expected one of the list": (
        "kein vorgeschlagener Punkt von Objekt {} ist gewählt; einen in der Liste wählen"
    ),
    "the mesh of object {} has changed, and the surface below feature points {} is gone; press Refresh Points, then "
    "place them anew or skip them": (
        "die Masche von Objekt {} hat sich geändert, und die Oberfläche unter den Merkmalspunkten {} fehlt; auf "
        "Punkte erneuern drücken, dann sie neu setzen oder überspringen"
    ),
    "the mesh of object {} has changed, and the surface below feature points {} is gone; press Refresh Points first": (
        "die Masche von Objekt {} hat sich geändert, und die Oberfläche unter den Merkmalspunkten {} fehlt; erst auf "
        "Punkte erneuern drücken"
    ),
    "the mesh of object {} is being changed, expected it out of Edit Mode": (
        "die Masche von Objekt {} wird gerade geändert; erst den Bearbeitungsmodus verlassen"
    ),
    "the new feature point has no name, expected an FDP number or a free name": (
        "der neue Merkmalspunkt hat keinen Namen; eine FDP-Nummer oder einen freien Namen angeben"
    ),
    "object {} has no feature point {} to remove": "Objekt {} hat keinen Merkmalspunkt {}, der zu entfernen wäre",
    "object {} has {} selected vertices, expected exactly one": (
        "Objekt {} hat {} ausgewählte Eckpunkte; genau einer wird gebraucht"
    ),
    "object {} has not skipped the feature point {}": "Objekt {} hat den Merkmalspunkt {} nicht übersprungen",
    "object {} has a feature point {} already, expected a new name": (
        "Objekt {} hat schon einen Merkmalspunkt {}; einen neuen Namen angeben"
    ),
    "feature point {} of object {} lies on vertex {}, expected 0 to {}": (
        "Merkmalspunkt {} von Objekt {} liegt auf Eckpunkt {}; es gibt 0 bis {}"
    ),
    "feature point {} of object {} has weights that add up to nothing": (
        "Merkmalspunkt {} von Objekt {} hat Gewichte, die zusammen nichts ergeben"
    ),
    "object {} has a modifier that makes its vertices anew, so that no place on it is one of its mesh; turn the "
    "modifier off in the viewport while you place points": (
        "Objekt {} hat einen Modifikator, der seine Eckpunkte neu macht, sodass keine Stelle darauf eine seiner "
        "Masche ist; ihn im Ansichtsfenster ausschalten, solange Punkte gesetzt werden"
    ),
    "object {} has no feature points to copy": "Objekt {} hat keine Merkmalspunkte zum Kopieren",
    "no other mesh object is selected, expected one that shall get the points of {}": (
        "kein anderes Maschenobjekt ist ausgewählt; eines auswählen, das die Punkte von {} bekommen soll"
    ),
    "object {} has another topology than {}, and {} feature points in common with it, expected at least {}: place "
    "them, or guess and accept them, then copy the others": (
        "Objekt {} hat eine andere Topologie als {} und {} Merkmalspunkte mit ihm gemeinsam; mindestens {} müssen es "
        "sein: sie setzen, oder raten und annehmen, dann die anderen kopieren"
    ),
    "the mouse is not over a 3D view: choose the Feature Points tool and click on the face": (
        "die Maus ist nicht über einer 3D-Ansicht: das Werkzeug Merkmalspunkte wählen und auf das Gesicht klicken"
    ),
    "no placed point is under the mouse": "unter der Maus ist kein gesetzter Punkt",
    "no proposed point is under the mouse, and the one whose turn it is is not proposed": (
        "unter der Maus ist kein vorgeschlagener Punkt, und der, der an der Reihe ist, ist nicht vorgeschlagen"
    ),
    "{} is the active face now: the next click places a point on it": (
        "{} ist jetzt das aktive Gesicht: der nächste Klick setzt einen Punkt darauf"
    ),
    "{} is not shown in this view: unhide it, or leave local view": (
        "{} ist in dieser Ansicht nicht zu sehen: einblenden, oder die lokale Ansicht verlassen"
    ),
    "{} is not under the mouse": "{} ist nicht unter der Maus",
    "in the same place as {}": "an derselben Stelle wie {:said}",
    "on the wrong side of {}": "auf der falschen Seite von {:said}",
    "a triangle of the base mesh folds over here": "ein Dreieck der Basismasche klappt hier um",
    "far from where the other points expect it": "weit von dort, wo die anderen Punkte ihn erwarten",
    "on another part of the mesh, such as lashes": "auf einem anderen Teil der Masche, etwa Wimpern",
    "feature points {} are missing": "Merkmalspunkte {} fehlen",
    "no face was found on the mesh: the average face differs from it by {}, expected less than {}; place at least {} "
    "points by hand": (
        "auf der Masche wurde kein Gesicht gefunden: das Durchschnittsgesicht weicht um {} ab, weniger als {} wird "
        "gebraucht; mindestens {} Punkte von Hand setzen"
    ),
    "{} of the {} wanted places have a point of the same name on the head, expected at least {}": (
        "{} der {} gewünschten Stellen haben einen gleichnamigen Punkt auf dem Kopf; mindestens {} müssen es sein"
    ),
    "none of the {} feature points has an MPEG-4 name, expected names such as 2.1, 8.3 and 8.4": (
        "keiner der {} Merkmalspunkte hat einen MPEG-4-Namen wie 2.1, 8.3 oder 8.4"
    ),
    "MPEG-4 points {} are missing, and {} others are too few to place them; expected these points, or at least {} of "
    "{}": (
        "MPEG-4-Punkte {} fehlen, und {} andere sind zu wenige, um sie zu setzen; nötig sind diese Punkte, oder "
        "mindestens {} aus {}"
    ),
    "points {} lie so close together on this mesh that some of them move as one": (
        "Punkte {} liegen auf dieser Masche so dicht beisammen, dass manche sich wie einer bewegen"
    ),
    # The base mesh.
    "object {} has no text attribute {} on its vertices, expected an object that Show Base Mesh has made": (
        "Objekt {} hat kein Text-Attribut {} auf seinen Eckpunkten; ein Objekt nehmen, das Basismasche zeigen "
        "erstellt hat"
    ),
    "base object {} has polygons of {} corners, expected triangles": (
        "Basisobjekt {} hat Polygone mit {} Ecken; Dreiecke werden gebraucht"
    ),
    "vertex {} of base object {} has no feature point, expected a name": (
        "Eckpunkt {} von Basisobjekt {} hat keinen Merkmalspunkt; er braucht einen Namen"
    ),
    "source and target have {} feature points in common, expected at least {} for a base mesh": (
        "Quelle und Ziel haben {} Merkmalspunkte gemeinsam; mindestens {} braucht eine Basismasche"
    ),
    "the base mesh uses points {}, which are not feature points of both faces": (
        "die Basismasche benutzt Punkte {}, die keine Merkmalspunkte beider Gesichter sind"
    ),
    "the base mesh has no triangles, expected at least one": "die Basismasche hat keine Dreiecke",
    "the base mesh has {} triangles at the edge {} - {}, expected at most 2: move one of these points": (
        "die Basismasche hat {} Dreiecke an der Kante {} - {}, höchstens 2 gehen: einen dieser Punkte verschieben"
    ),
    "the triangles on both sides of the edge {} - {} of the base mesh face different ways, expected all of them "
    "counter-clockwise seen from outside": (
        "die Dreiecke zu beiden Seiten der Kante {} - {} der Basismasche sehen in verschiedene Richtungen; von außen "
        "gesehen müssen alle gegen den Uhrzeigersinn laufen"
    ),
    "the base mesh hangs together by the point {} alone: move it or add points beside it": (
        "die Basismasche hängt allein am Punkt {} zusammen: ihn verschieben, oder Punkte daneben hinzufügen"
    ),
    "the base mesh folds over on the {} in {} triangles: move points of {}": (
        "die Basismasche klappt bei {:said} in {} Dreiecken um: Punkte von {} verschieben"
    ),
    "feature points {} lie outside the base and are not part of it": (
        "Merkmalspunkte {} liegen außerhalb der Basis und gehören nicht dazu"
    ),
    # Examples.
    "{} of object {} {} sculpted already; choose Replace to have it made anew": (
        "{:said} von Objekt {} {:said} schon geformt; Ersetzen wählen, um neu anzulegen"
    ),
    "{}: no expression, viseme or ARKit shape has such a name, expected one that has, or to be cloned or sculpted": (
        "{}: kein Ausdruck, Visem und keine ARKit-Form heißt so; klonen oder formen, oder einen solchen Namen nehmen"
    ),
    "object {} has no feature points that move in {}": "Objekt {} hat keine Merkmalspunkte, die sich in {} bewegen",
    "object {} shows nothing of {}, expected it sculpted there": "Objekt {} zeigt nichts von {}; dort erst formen",
    "example {} moves nothing on object {}, expected it sculpted": (
        "Beispiel {} bewegt nichts auf Objekt {}; erst formen"
    ),
    "object {} has the Multires modifier {}, which takes the strokes, expected one whose shape keys can be sculpted": (
        "Objekt {} hat den Hochauflösungs-Modifikator {}, der die Striche nimmt; ohne ihn formen"
    ),
    "shape key {} of object {} is locked, expected it unlocked": (
        "Formschlüssel {} von Objekt {} ist gesperrt; entsperren"
    ),
    "example {} is not on the list of {}, expected one that is": "Beispiel {} ist keines der {} auf der Liste",
    "object {} has no shape key {}, expected one for the example": (
        "Objekt {} hat keinen Formschlüssel {} für das Beispiel"
    ),
    "example {} moves no vertex of object {}, expected it sculpted on both faces": (
        "Beispiel {} bewegt keinen Eckpunkt von Objekt {}; auf beiden Gesichtern formen"
    ),
    "example {} has {} vertices, expected its neutral's {}": "Beispiel {} hat {} Eckpunkte, seine Neutrale {}",
    "no example is sculpted, expected at least one that both faces show": (
        "kein Beispiel ist geformt; mindestens eines brauchen beide Gesichter"
    ),
    "method {} learns nothing from examples as it is set, expected one that does": (
        "Methode {} lernt, wie sie eingestellt ist, nichts aus Beispielen; eine nehmen, die es tut"
    ),
    "examples are not used by this method": "Beispiele benutzt diese Methode nicht",
    "No shape key {} on {}: create it, or take the example off the list": (
        "Kein Formschlüssel {} auf {}: ihn erstellen, oder das Beispiel von der Liste nehmen"
    ),
    "Sculpted on {} alone: sculpt it on {} too, or rough it out there": (
        "Nur auf {} geformt: auch auf {} formen, oder dort anlegen"
    ),
    "The same as {} on {}: it teaches nothing; sculpt one of them otherwise": (
        "Dasselbe wie {} auf {}: es lehrt nichts; eines davon anders formen"
    ),
    "The others foretell {} worst: {} of its motion would be missing": (
        "{} sagen die anderen am schlechtesten vorher: {} seiner Bewegung würden fehlen"
    ),
    "{} is met but for {} of its motion": "{} ist getroffen bis auf {} seiner Bewegung",
    # Masks, preview, maps, report.
    "object {} has no vertex group {}, expected one for the mask": "Objekt {} hat keine Punktgruppe {} für die Maske",
    "vertex group {} is listed twice as a mask, expected it once": (
        "Punktgruppe {} steht zweimal als Maske auf der Liste; einmal genügt"
    ),
    "no method is chosen to be compared, expected one or more": (
        "keine Methode ist zum Vergleichen gewählt; mindestens eine wählen"
    ),
    "the target's vertices are not those that were fitted, expected a refresh": (
        "die Eckpunkte des Ziels sind nicht die, die angepasst wurden; neu anpassen"
    ),
    "modifier {} of object {} plays a cache over the preview, expected it off": (
        "Modifikator {} von Objekt {} spielt einen Zwischenspeicher über die Vorschau; ausschalten"
    ),
    "Changed since the fit: {}": "Seit der Anpassung geändert: {:said}",
    "method {} has no levels, expected one of {}": "Methode {} hat keine Stufen; welche haben {}",
    "material {} is linked from a library: the normal map is not wired there": (
        "Material {} ist aus einer Bibliothek verknüpft: die Normalmap ist dort nicht angeschlossen"
    ),
    "material {} shows the normal map on {} too": "Material {} zeigt die Normalmap auch auf {}",
    "object {} has flat faces, sharp edges or custom normals: the maps, which are made for smooth shading, look wrong "
    "there": (
        "Objekt {} hat flache Flächen, scharfe Kanten oder eigene Normalen: die Maps, für weiche Schattierung "
        "gemacht, sehen dort falsch aus"
    ),
    "material {} {}: the normal map is not wired there": (
        "Material {} {:said}: die Normalmap ist dort nicht angeschlossen"
    ),
    "{} has no texture coordinates, expected some for its normal maps; unwrap it, or make the maps for a level of its "
    "normal mesh": (
        "{:said} hat keine Texturkoordinaten für seine Normalmaps; abwickeln, oder die Maps für eine Stufe seiner "
        "Normalenmasche erstellen"
    ),
    "{} of {} frames have trouble": "{} von {} Bildern sind fehlerhaft",
    "Retargeted: {}": "Übertragen: {:said}",
    "{} of {} shape keys have trouble": "{} von {} Formschlüsseln sind fehlerhaft",
    "object {} has {} vertices, expected the {} that it had when this was found": (
        "Objekt {} hat {} Eckpunkte statt der {}, die es hatte, als das gefunden wurde"
    ),
    "{} has no {}, expected a row of the report with a figure there": (
        "bei {} gibt es das nicht ({:said}); eine Zeile des Berichts mit einer Zahl dort wählen"
    ),
    "all {} of {} are on the parts of {}, not on it": (
        "alles ({:said}, {}) ist auf den Teilen von {}, nicht darauf selbst"
    ),
    "object {} has a modifier that renumbers its vertices; turn it off in the viewport": (
        "Objekt {} hat einen Modifikator, der seine Eckpunkte umnummeriert; ihn im Ansichtsfenster ausschalten"
    ),
    "object {} is to be compared with its source: retarget first": (
        "Objekt {} soll mit seiner Quelle verglichen werden: erst übertragen"
    ),
    "the source's neutral is a frame: the map compares with its Basis alone": (
        "neutral ist bei der Quelle ein Bild: das Wärmebild vergleicht nur mit ihrer Basis"
    ),
    "source or target have other vertices than when they were retargeted: retarget again": (
        "Quelle oder Ziel haben andere Eckpunkte als bei der Übertragung: neu übertragen"
    ),
    "torn edges {}": "gerissene Kanten {:said}",
    "flipped triangles {}": "umgedrehte Dreiecke {:said}",
    "lip gap {}": "Lippenspalt {:said}",
    "lid gap {}": "Lidspalt {:said}",
    # Shape keys from head to head.
    "no set of the built-in actor is chosen, expected ARKit, visemes or expressions": (
        "kein Satz des eingebauten Darstellers ist gewählt; ARKit, Viseme oder Mimik wählen"
    ),
    "none of the {} selected mesh objects beside the source has feature points, expected faces": (
        "keines der {} ausgewählten Maschenobjekte neben der Quelle hat Merkmalspunkte; Gesichter auswählen"
    ),
    "object {} has no shape keys beside its Basis, expected some to clone": (
        "Objekt {} hat neben seiner Basis keine Formschlüssel zum Klonen"
    ),
    "object {} has no shape keys beside its Basis, expected some to save": (
        "Objekt {} hat neben seiner Basis keine Formschlüssel zum Speichern"
    ),
    "the Basis of object {} has the name of shape {}; rename one": (
        "die Basis von Objekt {} heißt wie Form {}; eine umbenennen"
    ),
    "object {} has no cloned shape keys, expected some of which one is corrected": (
        "Objekt {} hat keine geklonten Formschlüssel, von denen einer verbessert wäre"
    ),
    "none of the {} cloned shape keys of object {} is corrected, expected one that you have sculpted on or marked": (
        "keiner der {} geklonten Formschlüssel von Objekt {} ist verbessert; einen formen oder markieren"
    ),
    "all {} cloned shape keys of object {} are corrected: none is left": (
        "alle {} geklonten Formschlüssel von Objekt {} sind verbessert: keiner bleibt übrig"
    ),
    "the source has no shape {}, from which keys of object {} were cloned": (
        "die Quelle hat keine Form {}, aus der Schlüssel von Objekt {} geklont wurden"
    ),
    "object {} of head {} stays still; give it a role if it shall move": (
        "Objekt {} des Kopfes {} bleibt starr; ihm eine Rolle geben, wenn es sich bewegen soll"
    ),
    "strips of NLA track {} that are no clips are left out": (
        "Streifen der NLA-Spur {}, die keine Clips sind, bleiben weg"
    ),
    "NLA track {} of {} stays as it is": "NLA-Spur {} von {} bleibt, wie sie ist",
    "shapes that do not move the source: {}": "Formen, die die Quelle nicht bewegen: {}",
    "shapes that hardly move the target: {}": "Formen, die das Ziel kaum bewegen: {}",
    "parts of the target that hold no feature point and stay put: {} ({} vertices){}": (
        "Teile des Ziels, die keinen Merkmalspunkt tragen und stehen bleiben: {} ({} Eckpunkte){:said}"
    ),
    "{} means something only together with {}, but {} is not among the shapes: it was cloned alone": (
        "{} bedeutet nur zusammen mit {} etwas, aber {} ist nicht unter den Formen: allein geklont"
    ),
    "corrected shapes that do not move the source's points teach nothing: {}": (
        "verbesserte Formen, die die Punkte der Quelle nicht bewegen, lehren nichts: {}"
    ),
    "no counterpart for {}: {}": "kein Gegenstück für {}: {:said}",
    "no {} was found on the target: what the source's does has no counterpart": (
        "auf dem Ziel fehlt {:said}: was das der Quelle tut, hat kein Gegenstück"
    ),
    # What the checks find before a retargeting.
    "the source does not move: all its frames are the neutral face": (
        "die Quelle bewegt sich nicht: alle ihre Bilder sind das neutrale Gesicht"
    ),
    "the source moves rigidly: its frames are head motion only, expected a face that acts (was the face baked, or "
    "only the head that carries it?)": (
        "die Quelle bewegt sich starr: ihre Bilder sind nur Kopfbewegung, kein Gesicht, das spielt (wurde das Gesicht "
        "gebacken, oder nur der Kopf, der es trägt?)"
    ),
    "points that only the {} has are not used: {}": (
        "Punkte, die nur eine Seite ({:said}) hat, werden nicht benutzt: {}"
    ),
    "examples {} and {} are identical on the target": "Beispiele {} und {} sind auf dem Ziel gleich",
    "examples {} and {} are identical on the source, remove one": (
        "Beispiele {} und {} sind auf der Quelle gleich; eines entfernen"
    ),
    "example {} is missing on the {}": "Beispiel {} fehlt auf einer Seite ({:said})",
    "example {} does not move the source: it is the neutral face": (
        "Beispiel {} bewegt die Quelle nicht: es ist das neutrale Gesicht"
    ),
    "{} points {} lie on vertices that the {} do not include": (
        "{:said}: Punkte {} liegen auf Eckpunkten, die es unter {} nicht gibt"
    ),
    "{} points {} are NaN": "{:said}: Punkte {} sind NaN",
    "{}: {} of {} faces {}, the first is face {}; {}": "{:said}: {} von {} Flächen {:said}, die erste ist {}; {:said}",
    "{}: the faces look inwards, expected normals that point out of the head": (
        "{:said}: die Flächen sehen nach innen; ihre Normalen müssen aus dem Kopf zeigen"
    ),
    "{}: points {} lie on another part of the mesh than the others, such as lashes; move them onto the skin": (
        "{:said}: Punkte {} liegen auf einem anderen Teil der Masche als die übrigen, etwa auf Wimpern; sie auf die "
        "Haut verschieben"
    ),
    "{}: points {} lie in the same place; move or remove one of each": (
        "{:said}: Punkte {} liegen an derselben Stelle; je einen verschieben oder entfernen"
    ),
    "the base mesh uses points that the {} lacks: {}": "die Basismasche benutzt Punkte, die fehlen ({:said}): {}",
    "source and target have {} feature points in common (of {} and {}), expected at least {}{}": (
        "Quelle und Ziel haben {} Merkmalspunkte gemeinsam (von {} und {}); mindestens {} müssen es sein{:said}"
    ),
    "level {} over a base of {} points means about {} vertices, expected at most {}; use fewer levels": (
        "Stufe {} über einer Basis aus {} Punkten heißt etwa {} Eckpunkte, höchstens {} gehen; weniger Stufen nehmen"
    ),
    "left and right do not mirror each other in the mesh, and none of the points are pairs of left and right: "
    "expected such points, or polygons that mirror themselves": (
        "links und rechts spiegeln sich in der Masche nicht, und keine Punkte sind Paare von links und rechts: solche "
        "Punkte setzen, oder Polygone nehmen, die sich spiegeln"
    ),
}
"""English pattern -> German pattern."""

PHRASES = {
    ", {}": ", {:said}",
    "other": "sonstige",
    "{} and {}": "{:said} und {:said}",
    "behind the mouth": "hinter dem Mund",
    "eyeball": "Augapfel",
    "around an eye": "um ein Auge",
    "upper part of the mouth": "oberer Teil des Mundes",
    "lower part of the mouth": "unterer Teil des Mundes",
    "inside of the mouth": "das Innere des Mundes",
    "brow": "Braue",
    "mouth": "Mund",
    "cheek": "Wange",
    "neck": "Hals",
    "nose": "Nase",
    "ear": "Ohr",
    "forehead": "Stirn",
    "left eyeball": "linker Augapfel",
    "right eyeball": "rechter Augapfel",
    "upper teeth": "obere Zähne",
    "lower teeth": "untere Zähne",
    "gums": "Zahnfleisch",
    "tongue": "Zunge",
    "lashes": "Wimpern",
    "brows": "Brauen",
    "moustache": "Schnurrbart",
    "beard": "Bart",
    "upper row of teeth": "die obere Zahnreihe",
    "lower row of teeth": "die untere Zahnreihe",
    "acts on the {}, which the target lacks": "wirkt auf Teile ({:said}), die dem Ziel fehlen",
    "acts on the {} alone, which moves nothing here": "wirkt allein auf Teile ({:said}), und das bewegt hier nichts",
    "needs {}, which has no counterpart": "braucht {}, das kein Gegenstück hat",
    "torn edges": "gerissene Kanten",
    "turned triangles": "umgedrehte Dreiecke",
    "gap between the lips": "Spalt zwischen den Lippen",
    "gap between the lids": "Spalt zwischen den Lidern",
    "source": "Quelle",
    "target": "Ziel",
    "object {}": "Objekt {}",
    "example {} of the {}": "Beispiel {} ({:said})",
    "{} neutral": "Neutrale ({:said})",
    "is": "ist",
    "are": "sind",
    "no example": "kein Beispiel",
    "file": "Datei",
    "folder": "Ordner",
    "cache": "den Zwischenspeicher",
    "normal maps": "die Normalmaps",
    "Bake": "Backen",
    "Normal Maps": "Normalmaps",
    " onto {} heads": " auf {} Köpfe",
    "exactly": "genau",
    "through the fit of the surfaces": "über die Anpassung der Oberflächen",
    "its FAP controls": "seine FAP-Regler",
    "its mesh": "seine Masche",
    "{} shape keys": "{} Formschlüssel",
    "those of that half": "denen dieser Hälfte",
    "has a normal of its own": "hat eine eigene Normale",
    "has no Principled shader": "hat keinen Principled-Shader",
    "method": "Methode",
    "settings": "Einstellungen",
    "meshes": "Maschen",
    "points": "Punkte",
    "parts": "Teile",
    "examples": "Beispiele",
    "base mesh": "Basismasche",
    "neutral": "Neutrale",
    "meet at edges of more than two faces": "treffen sich an Kanten mit mehr als zwei Flächen",
    "have no area": "haben keinen Inhalt",
    "are flipped against their neighbours": "sind gegen ihre Nachbarn gewendet",
    "expected at most {}": "höchstens {} gehen",
    "they are left to their neighbours": "sie bleiben ihren Nachbarn überlassen",
    " or a base mesh of your own": ", oder eine eigene Basismasche",
}
"""The same for what stands in such a sentence as a value."""
