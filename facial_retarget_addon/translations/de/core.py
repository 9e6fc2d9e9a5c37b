"""What the core finds wrong with what it is given."""

SENTENCES = {
    # Methods and their settings.
    "method {} is unknown, expected one of {}": "Methode {} ist unbekannt; es gibt {}",
    "{} has no setting {}; there are {}": "{} hat keine Einstellung {}; es gibt {}",
    "{} {} = {}: expected {}": "{} {} = {}: gebraucht wird {:said}",
    "level {} was asked for, and the method has levels 1 to {}": "Stufe {} ist verlangt, und die Methode hat 1 bis {}",
    "the hierarchy starts from {} base vertices, but {} points arrived": (
        "die Stufen beginnen bei {} Eckpunkten der Basis, aber {} Punkte sind angekommen"
    ),
    "the regions of the {} feature points do not meet on the surface, expected points spread over the face: move {}": (
        "die Bereiche der {} Merkmalspunkte treffen sich auf der Oberfläche nicht; die Punkte über das Gesicht "
        "verteilen: {} verschieben"
    ),
    "no skin around the {} feature points is seen from outside, expected a surface whose normals point outwards": (
        "um die {} Merkmalspunkte ist von außen keine Haut zu sehen; die Normalen der Oberfläche müssen nach außen "
        "zeigen"
    ),
    "the {} feature points of both faces span no triangle around the head, expected at least 3 that are not above one "
    "another": (
        "die {} Merkmalspunkte beider Gesichter spannen um den Kopf kein Dreieck auf; mindestens 3 dürfen nicht "
        "übereinander liegen"
    ),
    "a surface without faces has no closest point": "eine Oberfläche ohne Flächen hat keinen nächsten Punkt",
    "the faces have {} feature points in common, expected at least 4 that are not in one plane": (
        "die Gesichter haben {} Merkmalspunkte gemeinsam; mindestens 4 dürfen nicht in einer Ebene liegen"
    ),
    "{}: feature points {} lie on another component than the other {}, expected all of them on the face's surface": (
        "{:said}: Merkmalspunkte {} liegen auf einem anderen Bestandteil als die übrigen {}; alle müssen auf der "
        "Oberfläche des Gesichts liegen"
    ),
    "{}: feature points {} and {} lie in the same place, expected different places": (
        "{:said}: Merkmalspunkte {} und {} liegen an derselben Stelle"
    ),
    "a warp needs at least 4 matched points, {} arrived": (
        "eine Verformung braucht mindestens 4 zugeordnete Punkte; angekommen sind {}"
    ),
    "all {} points lie in one plane, expected points spread over a face": (
        "alle {} Punkte liegen in einer Ebene; sie müssen über ein Gesicht verteilt sein"
    ),
    "two feature points lie in the same place, expected different places": (
        "zwei Merkmalspunkte liegen an derselben Stelle"
    ),
    "tolerance {} and reach {} arrived, expected numbers above 0": (
        "Toleranz {} und Reichweite {} sind angekommen; beide müssen größer als 0 sein"
    ),
    "{} is no way to mirror, expected one of {}": "{} ist keine Weise zu spiegeln; es gibt {}",
    "alignment: some positions are NaN or infinite, expected finite positions": (
        "Ausrichtung: manche Positionen sind NaN oder unendlich"
    ),
    "alignment: the {} {} positions lie on one line or in one place, expected positions spread over a face": (
        "Ausrichtung: die {} Positionen ({:said}) liegen auf einer Linie oder an einer Stelle; sie müssen über ein "
        "Gesicht verteilt sein"
    ),
    # Meshes.
    "the subdivision scheme moves old vertices, expected one that keeps them for wavelets": (
        "die Art der Unterteilung bewegt alte Eckpunkte; für Wavelets müssen sie bleiben"
    ),
    "a mesh of {} vertices and {} faces has edges of more than two faces or faces of both orientations, expected a "
    "manifold, oriented mesh to subdivide": (
        "eine Masche aus {} Eckpunkten und {} Flächen hat Kanten mit mehr als zwei Flächen oder Flächen beider "
        "Ausrichtungen; so lässt sie sich nicht unterteilen"
    ),
    "{} has a face with vertex {}, expected 0 to {}": "{:said} hat eine Fläche mit Eckpunkt {}; es gibt 0 bis {}",
    "polygons name {} corners, but {} arrived": "Polygone nennen {} Ecken, aber {} sind angekommen",
    "polygon {} has {} corners, expected at least 3": "Polygon {} hat {} Ecken; mindestens 3 müssen es sein",
    "all {} faces of the face are without area, expected a surface": (
        "alle {} Flächen des Gesichts sind ohne Inhalt; eine Oberfläche wird gebraucht"
    ),
    # Points and parts.
    "feature points lie on vertices that the face's {} do not include": (
        "Merkmalspunkte liegen auf Eckpunkten, die es unter den {} des Gesichts nicht gibt"
    ),
    "feature points: {} names, {} places and {} weights arrived, expected as many of each": (
        "Merkmalspunkte: {} Namen, {} Stellen und {} Gewichte sind angekommen; es müssen gleich viele sein"
    ),
    "feature point {} appears twice, expected unique names": "Merkmalspunkt {} kommt zweimal vor",
    "a part is named {}, expected one of {}": "ein Teil heißt {}; es gibt {}",
    "part {} has {} {}, expected a list of vertices": "Teil {} hat {} {}; es muss eine Liste von Eckpunkten sein",
    "part {} has vertices that the {} do not include": "Teil {} hat Eckpunkte, die es unter den {} nicht gibt",
    "part {} and {} are one connected piece, expected separate ones": (
        "Teil {} und {} hängen zusammen; sie müssen getrennt sein"
    ),
    # Shapes and keys.
    "there is no set {}, expected some of {}": "einen Satz {} gibt es nicht; es gibt {}",
    "there is no variant {}, expected {}": "eine Variante {} gibt es nicht; es gibt {}",
    "no shape is called {}; the {} shapes are {}": "keine Form heißt {}; die {} Formen sind {}",
    "no shape is left of {}: keep {}, drop {}": "keine Form bleibt von {}: behalten {}, weglassen {}",
    "the shapes have {} vertices, expected {} as the source": "die Formen haben {} Eckpunkte, die Quelle {}",
    "no shapes arrived, expected at least one": "keine Formen sind angekommen",
    "the corrected shapes have {} vertices, expected {} as the target": (
        "die verbesserten Formen haben {} Eckpunkte, das Ziel {}"
    ),
    "corrected shapes {} are not among the source's {}": "verbesserte Formen {} sind nicht unter denen der Quelle: {}",
    "shapes {} are missing": "Formen {} fehlen",
    "shapes of {} and of {} vertices arrived, expected the same face": (
        "Formen mit {} und mit {} Eckpunkten sind angekommen; es muss dasselbe Gesicht sein"
    ),
    "shape {} appears twice, expected unique names": "Form {} kommt zweimal vor",
    "shape {} has {} vertices that are NaN or infinite, the first is vertex {}; expected finite positions": (
        "Form {} hat {} Eckpunkte, die NaN oder unendlich sind, der erste ist {}"
    ),
    "{} has nothing to be added up, expected names of shapes": "{} hat nichts, was zu addieren wäre: Namen von Formen",
    "the border between left and right is {} wide, expected 0 or more": (
        "die Grenze zwischen links und rechts ist {} breit; sie darf nicht unter 0 sein"
    ),
    "example {} is missing on the {}, expected one on each face": (
        "Beispiel {} fehlt auf einer Seite ({:said}); jedes Gesicht braucht eines"
    ),
    "example {} moves the target but not the source's feature points, expected motion on both": (
        "Beispiel {} bewegt das Ziel, aber nicht die Merkmalspunkte der Quelle; beide müssen sich bewegen"
    ),
    "none of the rig's {} shapes moves a vertex, expected some that do": (
        "keine der {} Formen des Rigs bewegt einen Eckpunkt"
    ),
    "the rig has a shape {}, expected another name than those of residual keys": (
        "das Rig hat eine Form {}; so heißen Schlüssel des Rests, sie braucht einen anderen Namen"
    ),
    "none of {} shape keys moves a vertex, expected keys to fit the frames with": (
        "keiner von {} Formschlüsseln bewegt einen Eckpunkt, um die Bilder damit anzupassen"
    ),
    "shape key {} ranges from {} to {}, expected a range": (
        "Formschlüssel {} reicht von {} bis {}; das ist kein Bereich"
    ),
    # Normal maps.
    "the mesh has {} pieces and {} borders, expected one piece with at least one border": (
        "die Masche hat {} Stücke und {} Ränder; gebraucht wird ein Stück mit mindestens einem Rand"
    ),
    "texture coordinates from ({}, {}) to ({}, {}) cover no pixel of UDIM tile {} at {} pixels, expected them inside "
    "it": (
        "Texturkoordinaten von ({}, {}) bis ({}, {}) bedecken kein Pixel der UDIM-Kachel {} bei {} Pixeln; sie müssen "
        "darin liegen"
    ),
    "texture coordinates from ({}, {}) to ({}, {}) lie in no UDIM tile, expected some from (0, 0) on": (
        "Texturkoordinaten von ({}, {}) bis ({}, {}) liegen in keiner UDIM-Kachel; sie beginnen bei (0, 0)"
    ),
    "texture coordinates are NaN or infinite, expected finite ones": "Texturkoordinaten sind NaN oder unendlich",
    # The MPEG-4 face.
    "the head's motion needs {} points that no FAP moves, such as corners of the eyes and hairline, but the face has "
    "{}": (
        "die Bewegung des Kopfes braucht {} Punkte, die kein FAP bewegt, etwa Augenwinkel und Haaransatz, aber das "
        "Gesicht hat {}"
    ),
    "frame {} of {} selects {} {}, expected 0 to {}": "Bild {} von {} wählt {} {}; es gibt 0 bis {}",
    "unused FAPs are to be treated as {}, expected 'hold' or 'zero'": (
        "unbenutzte FAPs sollen als {} gelten; es gibt 'hold' und 'zero'"
    ),
    "the unit {} of the neutral face is {} ({}), expected a length greater than zero: eyes open, mouth closed, and "
    "left points on the subject's left": (
        "das Maß {} des neutralen Gesichts ist {} ({}) und muss größer als null sein: Augen offen, Mund geschlossen, "
        "und linke Punkte auf der linken Seite der Person"
    ),
    "no left and right MPEG-4 points that belong together are among the {} given, expected at least one pair such as "
    "8.3 and 8.4": (
        "unter den {} angegebenen sind keine zusammengehörigen linken und rechten MPEG-4-Punkte; mindestens ein Paar "
        "wie 8.3 und 8.4 wird gebraucht"
    ),
    "none of the {} feature points has an MPEG-4 name, expected names such as 2.1": (
        "keiner der {} Merkmalspunkte hat einen MPEG-4-Namen wie 2.1"
    ),
    # Markers.
    "marker assignment: {} assigned markers have points on the face, expected at least {} to propose others by their "
    "places": (
        "Markerzuordnung: {} zugeordnete Marker haben Punkte auf dem Gesicht; mindestens {} braucht es, um andere "
        "nach ihrer Lage vorzuschlagen"
    ),
    "markers: left and right seem to be swapped, the face would look backwards; expected left points on the actor's "
    "left": (
        "Marker: links und rechts scheinen vertauscht, das Gesicht sähe nach hinten; linke Punkte gehören auf die "
        "linke Seite des Darstellers"
    ),
    "markers: FAP {} has the gain {}, expected a finite gain of a FAP that a marker measures": (
        "Marker: FAP {} hat die Stärke {}; gebraucht wird eine endliche, für einen FAP, den ein Marker misst"
    ),
    "markers of {}: gaps shall be {}, expected one of {}": "Marker von {}: Lücken sollen {} werden; es gibt {}",
    "markers of {} have {} gaps, expected none: {}": "Marker von {} haben {} Lücken, und es darf keine geben: {:said}",
    "markers of {}: {}, expected gaps of at most {} s": "Marker von {}: {:said}; Lücken dürfen höchstens {} s dauern",
    "markers of {}: {}{} are never seen in {} frames; leave them out": (
        "Marker von {}: {}{} sind in {} Bildern nie zu sehen; sie weglassen"
    ),
    "head motion: {} of the {} markers are seen in the neutral frame and in half of the others, expected at least {}": (
        "Kopfbewegung: {} der {} Marker sind im neutralen Bild und in der Hälfte der anderen zu sehen; mindestens {} "
        "müssen es sein"
    ),
    "head motion: the {} markers of the neutral frame lie on one line": (
        "Kopfbewegung: die {} Marker des neutralen Bildes liegen auf einer Linie"
    ),
    "head motion: the rigid markers in {} lie on one line or in one place, which leaves the head's turn open; "
    "expected three that span a triangle": (
        "Kopfbewegung: die starren Marker liegen auf einer Linie oder an einer Stelle ({:said}), sodass die Drehung "
        "des Kopfes offen bleibt; drei müssen ein Dreieck aufspannen"
    ),
    "head motion: frame {} shows {} of the {} rigid markers, expected at least {}": (
        "Kopfbewegung: Bild {} zeigt {} der {} starren Marker; mindestens {} müssen es sein"
    ),
    "head motion: the method is {}, expected one of {}": "Kopfbewegung: die Methode ist {}; es gibt {}",
    "head motion: {} rigid markers arrived, but the linear method takes exactly {}": (
        "Kopfbewegung: {} starre Marker sind angekommen, aber die lineare Methode nimmt genau {}"
    ),
    "markers: more than one sits on {}, expected one marker to a point": (
        "Marker: mehr als einer sitzt auf {}; auf jeden Punkt gehört einer"
    ),
    "markers of {}: the neutral frames are {} to {}, expected frames from 1 to {}": (
        "Marker von {}: die neutralen Bilder sind {} bis {}; es gibt 1 bis {}"
    ),
    "markers of {}: {} is not seen in frame {}, expected a take whose gaps are filled": (
        "Marker von {}: {} ist in Bild {} nicht zu sehen; die Lücken der Aufnahme füllen"
    ),
    "markers {} are not in the take {}": "Marker {} sind nicht in der Aufnahme {}",
}
"""English pattern -> German pattern."""

PHRASES = {
    "marker {} is hidden for {} s from frame {}": "Marker {} ist {} s lang verdeckt, ab Bild {}",
    "the neutral frame": "das neutrale Bild",
    "frame {}": "Bild {}",
    "a whole number": "eine ganze Zahl",
    "a number": "eine Zahl",
    "one of {}": "eines von {}",
    "true or false": "true oder false",
}
"""The same for what stands in such a sentence as a value."""
