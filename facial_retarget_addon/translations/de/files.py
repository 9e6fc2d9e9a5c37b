"""What is wrong inside files, and with where they shall be written."""

SENTENCES = {
    # Reading and writing.
    "{} cannot be read: {}": "{} lässt sich nicht lesen: {:said}",
    "{} cannot be written: {}": "{} lässt sich nicht schreiben: {:said}",
    "{} cannot be written: there is no folder {}": "{} lässt sich nicht schreiben: den Ordner {} gibt es nicht",
    "{} cannot be written: the folder {} may not be changed": (
        "{} lässt sich nicht schreiben: der Ordner {} darf nicht geändert werden"
    ),
    "{} cannot be written: it is a folder, expected a file": (
        "{} lässt sich nicht schreiben: es ist ein Ordner, keine Datei"
    ),
    "{} cannot be written: Blender did not get to its end; the disk may be full": (
        "{} lässt sich nicht schreiben: Blender ist nicht bis zum Ende gekommen; vielleicht ist die Platte voll"
    ),
    "{} and {} are one file, expected different ones": "{} und {} sind dieselbe Datei; es müssen verschiedene sein",
    "{} lies in {}, a folder that is replaced; expected it elsewhere": (
        "{} liegt in {}, einem Ordner, der ersetzt wird; anderswo ablegen"
    ),
    "folder {} holds {}; expected a new folder, or one that holds {} files only, since it is replaced": (
        "Ordner {} enthält {}; er wird ersetzt: einen neuen nehmen, oder einen, in dem nur {}-Dateien sind"
    ),
    "{} ends in {}, expected {} for {}": "{} endet auf {}; für {3} muss es {2} sein",
    "pictures of depth {} are not known, expected one of {}": "Bilder der Tiefe {} gibt es nicht; es gibt {}",
    # Faces.
    "mesh {} is a {}, expected one of {}": "Masche {} ist {:said}; es gibt {}",
    "{} has a polygon with {} corners, expected at most {}": "{} hat ein Polygon mit {} Ecken; höchstens {} gehen",
    "{} has {} vertices that are NaN, infinite or farther than {}, the first is vertex {}; expected finite positions": (
        "{} hat {} Eckpunkte, die NaN, unendlich oder weiter als {} weg sind, der erste ist {}"
    ),
    "{} is malformed: {}": "{} ist fehlerhaft: {}",
    "{}: a {} line is malformed, expected numbers after its keyword": (
        "{}: eine Zeile {} ist fehlerhaft; nach dem Schlüsselwort gehören Zahlen"
    ),
    "{}: line {} has {} numbers, expected {}": "{}: Zeile {} hat {} Zahlen; es müssen {} sein",
    "{}: a face has the index {}, but there are {}; expected 1 to {}": (
        "{}: eine Fläche hat den Index {}, aber es gibt {}: 1 bis {}"
    ),
    "{} is no PLY mesh: {}": "{} ist keine PLY-Masche: {}",
    "{} is no NPZ file of plain numbers: {}": "{} ist keine NPZ-Datei aus einfachen Zahlen: {}",
    "{} has no array 'weights', expected one number for each vertex": (
        "{} hat kein Array 'weights' mit einer Zahl je Eckpunkt"
    ),
    "{} has weights that do not lie between 0 and 1": "{} hat Gewichte, die nicht zwischen 0 und 1 liegen",
    # Frames.
    "{} is no PC2 file: it starts with {}": "{} ist keine PC2-Datei: sie beginnt mit {}",
    "{} ends after {} bytes, inside its header": "{} endet nach {} Bytes, in ihrem Kopf",
    "folder {} holds no .obj files, expected one for each frame": (
        "Ordner {} enthält keine .obj-Dateien, eine für jedes Bild"
    ),
    "frames {} are a {}, expected one of .npz, .pc2, .mdd or a folder of .obj files": (
        "Bilder {} sind {:said}; gebraucht wird .npz, .pc2, .mdd oder ein Ordner mit .obj-Dateien"
    ),
    "{} holds {} bytes, expected {} for {} frames of {} vertices": (
        "{} enthält {} Bytes; für {3} Bilder mit {4} Eckpunkten müssen es {2} sein"
    ),
    "{} has {} vertices, expected {} as in {}": "{} hat {} Eckpunkte; wie in {3} müssen es {2} sein",
    "{} has no [source] frames, expected the frames to retarget": (
        "{} hat keine [source] frames, die zu übertragen wären"
    ),
    # Points and parts.
    "its points lie on a mesh of {} vertices, and the one that arrived has {}": (
        "ihre Punkte liegen auf einer Masche mit {} Eckpunkten, und die angekommene hat {}"
    ),
    "{} is at {}, expected vertices from 0 to {}": "{:said} liegt auf {}; es gibt Eckpunkte von 0 bis {}",
    "part {} is at {}, expected vertices from 0 to {}": "Teil {} liegt auf {}; es gibt Eckpunkte von 0 bis {}",
    "{} has weights {} with the sum {}, expected none below 0 and a sum of 1": (
        "{:said} hat Gewichte {} mit der Summe {}; keines darf unter 0 sein, und die Summe muss 1 sein"
    ),
    "a point is named {}, expected a readable name": "ein Punkt heißt {}; er braucht einen lesbaren Namen",
    "{} has no place, expected vertex, vertices and weights, or position": (
        "{:said} hat keine Stelle: vertex, vertices und weights, oder position"
    ),
    "point {} lies {} away from the surface, expected at most {}": (
        "Punkt {} liegt {} von der Oberfläche weg; höchstens {} gehen"
    ),
    "groups are those of an .obj file, but the neutral is {}": "Gruppen hat eine .obj-Datei, aber die Neutrale ist {}",
    "{} has groups {}, expected some of those with faces: {}": "{:said} hat Gruppen {}; welche mit Flächen sind {}",
    "there are no triangles, expected some": "es gibt keine Dreiecke",
    "triangle {} is {}, expected three different point names": (
        "Dreieck {} ist {}; es braucht drei verschiedene Punktnamen"
    ),
    # Shapes.
    "the table has no shapes, expected at least one": "die Tabelle hat keine Formen",
    "{} has {} vertices and {} displacements, expected one for each": (
        "{:said} hat {} Eckpunkte und {} Verschiebungen; es muss je eine sein"
    ),
    "{} has displacements that are not three finite numbers each": (
        "{:said} hat Verschiebungen, die nicht je drei endliche Zahlen sind"
    ),
    "{} has vertices {}, expected different ones from 0 to {}": (
        "{:said} hat Eckpunkte {}; es müssen verschiedene von 0 bis {} sein"
    ),
    "a shape is named {}, expected a readable name": "eine Form heißt {}; sie braucht einen lesbaren Namen",
    "{} is no set of shapes, expected a folder of .obj or .ply files, an .npz or a .json": (
        "{} ist kein Satz von Formen: ein Ordner mit .obj- oder .ply-Dateien, .npz oder .json"
    ),
    "folder {} holds no {} files, expected one for each shape": (
        "Ordner {} enthält keine Dateien {}, eine für jede Form"
    ),
    "folder {} holds two meshes of shape {}, expected one": "Ordner {} enthält zwei Maschen der Form {}",
    "shapes {} would be a {}, expected a folder of {} files, an .npz or a .json": (
        "Formen {} wären {:said}; gebraucht wird ein Ordner mit {}-Dateien, .npz oder .json"
    ),
    "{}: shape {} has vertices that are NaN, infinite or far away": (
        "{}: Form {} hat Eckpunkte, die NaN, unendlich oder weit weg sind"
    ),
    "shape {} cannot be a file in {}; write an .npz or a .json instead": (
        "Form {} kann keine Datei in {} sein; stattdessen .npz oder .json schreiben"
    ),
    "shapes {} and {} would be one file in {} on some systems; write an .npz or a .json instead": (
        "Formen {} und {} wären auf manchen Systemen dieselbe Datei in {}; stattdessen .npz oder .json schreiben"
    ),
    "{} cannot be written: shape key {} has the value {} at frame {}, expected a finite one": (
        "{} lässt sich nicht schreiben: Formschlüssel {} hat in Bild {3} den Wert {2}, der nicht endlich ist"
    ),
    "curves {} would be a {}, expected .csv or .json": "Kurven {} wären {:said}; .csv oder .json wird gebraucht",
    # Job files.
    "{} is no {} document: {}": "{} ist kein {}-Dokument: {}",
    "{} is missing, expected {}": "{} fehlt; gebraucht wird {:said}",
    "{} = {}, expected {}": "{} = {}; gebraucht wird {:said}",
    "{} is {}, expected a table": "{} ist {}; gebraucht wird eine Tabelle",
    "{} is unknown, expected one of {}": "{} ist unbekannt; es gibt {}",
    "{} name {} appears twice, expected unique names": "{} name {} kommt zweimal vor",
    "{} appears twice, expected unique names": "{} kommt zweimal vor",
    "{} cannot stand in a job file: it is no Unicode text": (
        "{} kann in keiner Auftragsdatei stehen: es ist kein Unicode-Text"
    ),
    "targets is empty, expected at least one [[targets]]": (
        "targets ist leer; mindestens ein [[targets]] wird gebraucht"
    ),
    # Motion.
    "{} is no file, expected {}": "{} ist keine Datei; gebraucht wird {:said}",
    "{} is empty, expected {}": "{} ist leer; gebraucht wird {:said}",
    "{} has {} GiB, expected {} of at most {} GiB": "{} hat {} GiB; gebraucht wird {:said} mit höchstens {} GiB",
    "{} starts with {}, so it is not {}": "{} beginnt mit {} und ist deshalb keines davon: {:said}",
    "motion {} is a {}, expected one of {}": "Bewegung {} ist {:said}; es gibt {}",
    "markers {} are a {}, expected {}": "Marker {} sind {:said}; gebraucht wird {}",
    "frames {} to {} are wanted, but the take has {}": "Bilder {} bis {} sind gewünscht, aber die Aufnahme hat {}",
    "{} has no frames": "{} hat keine Bilder",
    "{} has no header, expected {}": "{} hat keine Kopfzeile; gebraucht wird {:said}",
    "{}: the header in line {} is malformed: {}": "{}: die Kopfzeile in Zeile {} ist fehlerhaft: {}",
    "{}: line {} is malformed: {}": "{}: Zeile {} ist fehlerhaft: {}",
    "{}: line {} has {} cells, expected {} as in the header": (
        "{}: Zeile {} hat {} Zellen; wie in der Kopfzeile müssen es {} sein"
    ),
    "{} has no column {}{}": "{} hat keine Spalte {}{:said}",
    "{} has the column {} twice": "{} hat die Spalte {} zweimal",
    "{} is no ARKit CSV: none of its columns is named like one of the 52 weights": (
        "{} ist keine ARKit-CSV: keine ihrer Spalten heißt wie eines der 52 Gewichte"
    ),
    "{}: line {} has a value that is missing or not finite": (
        "{}: Zeile {} hat einen Wert, der fehlt oder nicht endlich ist"
    ),
    "{}: line {} has {} = {}, expected weights from 0 to 1": ("{}: Zeile {} hat {} = {}; Gewichte reichen von 0 bis 1"),
    "{} cannot be written: the take has no frames, or a number that is not finite": (
        "{} lässt sich nicht schreiben: die Aufnahme hat keine Bilder, oder eine Zahl, die nicht endlich ist"
    ),
    "{} has no times, expected a column of seconds or the frames a second": (
        "{} hat keine Zeiten; gebraucht wird eine Spalte mit Sekunden oder die Bilder je Sekunde"
    ),
    "{} says {} frames a second, but its times are those of {}": (
        "{} sagt {} Bilder je Sekunde, aber die Zeiten sagen {}"
    ),
    "{} has {} frames a second, expected a number from {} to {}": (
        "{} hat {} Bilder je Sekunde; es muss eine Zahl von {} bis {} sein"
    ),
    "{} has {} frames, expected at least two: their times tell the rate": (
        "{} hat {} Bilder; mindestens zwei müssen es sein: ihre Zeiten sagen die Rate"
    ),
    "{}: the time of frame {} is not after the frame before, expected growing times": (
        "{}: die Zeit von Bild {} liegt nicht nach dem Bild davor"
    ),
    "{}: {} frames are missing between {}, expected at most as many": (
        "{}: {} Bilder fehlen zwischen {}; höchstens so viele dürfen fehlen"
    ),
    "{} says {} frames a second, but its {} frames last {} s by their times, expected {} s": (
        "{} sagt {} Bilder je Sekunde, aber seine {} Bilder dauern nach ihren Zeiten {} s statt {} s"
    ),
    "{} has the timecode {}, expected hours:minutes:seconds:frames": (
        "{} hat den Timecode {}; es muss Stunden:Minuten:Sekunden:Bilder sein"
    ),
    "{} has neither ARKit weights nor markers, expected columns such as JawOpen, or chin_x, chin_y and chin_z": (
        "{} hat weder ARKit-Gewichte noch Marker; gebraucht werden Spalten wie JawOpen, oder chin_x, chin_y und chin_z"
    ),
    "{} has no markers, expected columns such as chin_x, chin_y and chin_z": (
        "{} hat keine Marker; gebraucht werden Spalten wie chin_x, chin_y und chin_z"
    ),
    "{}: marker {} has no column for {}": "{}: Marker {} hat keine Spalte für {}",
    "{} has {} markers and {} frames, expected at least one of each": (
        "{} hat {} Marker und {} Bilder; mindestens je eins wird gebraucht"
    ),
    "{}: marker {} is farther than {} away in frame {}": "{}: Marker {} ist in Bild {3} weiter als {2} weg",
    "{}: marker {} appears twice or has no name, expected unique names": (
        "{}: Marker {} kommt zweimal vor oder hat keinen Namen"
    ),
    "{} holds no markers, so that the marker map {} says nothing about it": (
        "{} enthält keine Marker, sodass die Markerzuordnung {} nichts dazu sagt"
    ),
    "{}: none of the {} markers is named after a feature point, such as {}; expected names such as 8.3, L_brow_inner "
    "or mouth_corner_r, or a marker map": (
        "{}: keiner der {} Marker heißt nach einem Merkmalspunkt, etwa {}; gebraucht werden Namen wie 8.3, "
        "L_brow_inner oder mouth_corner_r, oder eine Markerzuordnung"
    ),
    "{} of {} markers do not say by their names where they sit: {}": (
        "{} von {} Markern sagen mit ihren Namen nicht, wo sie sitzen: {}"
    ),
    "{} frames that the recording left out are filled along straight lines": (
        "{} Bilder, die die Aufzeichnung ausgelassen hat, sind geradlinig gefüllt"
    ),
    "rigid = {}, expected names of markers, each once": "rigid = {}; gebraucht werden Namen von Markern, jeder einmal",
    "rigid names {} markers, expected at least {}, or none to have them found": (
        "rigid nennt {} Marker; mindestens {}, oder keine, damit sie gefunden werden"
    ),
    "marker {} sits on {}, expected the name of a feature point": (
        "Marker {} sitzt auf {}; gebraucht wird der Name eines Merkmalspunkts"
    ),
    "markers {} and {} both sit on {}, expected one marker to a point": (
        "Marker {} und {} sitzen beide auf {}; auf jeden Punkt gehört einer"
    ),
    "{} is no FAP stream: it starts with {}, expected a version, a name, frames a second and the number of frames": (
        "{} ist kein FAP-Strom: er beginnt mit {} statt mit Version, Name, Bildern je Sekunde und Anzahl der Bilder"
    ),
    "{} says {} frames, but {} whole ones follow": "{} sagt {} Bilder, aber {} ganze folgen",
    "{} says {} frames, but {} follow": "{} sagt {} Bilder, aber {} folgen",
    "{}: line {} has a value that is no number": "{}: Zeile {} hat einen Wert, der keine Zahl ist",
    "{}: line {} has {}, expected a number": "{}: Zeile {} hat {}; gebraucht wird eine Zahl",
    "{}: line {} has {} values, expected {}": "{}: Zeile {} hat {} Werte; es müssen {} sein",
    "{}: line {} has {}, expected at most {}": "{}: Zeile {} hat {}; höchstens {} gehen",
    "{} cannot be written: the FAP stream has no frames": (
        "{} lässt sich nicht schreiben: der FAP-Strom hat keine Bilder"
    ),
    "{} cannot be written: frame {} has a value that is not finite or beyond {}": (
        "{} lässt sich nicht schreiben: Bild {} hat einen Wert, der nicht endlich oder größer als {} ist"
    ),
    "{} is no BVH file: expected a HIERARCHY and then a MOTION, each on a line of its own": (
        "{} ist keine BVH-Datei: HIERARCHY und dann MOTION müssen je in einer eigenen Zeile stehen"
    ),
    "{} is no TRC file: it starts with {}, expected 'PathFileType'": (
        "{} ist keine TRC-Datei: sie beginnt mit {} statt mit 'PathFileType'"
    ),
    "{} is a malformed C3D file: {}": "{} ist eine fehlerhafte C3D-Datei: {}",
    "{} says {} frames of {} markers, but ends before them": "{} sagt {} Bilder mit {} Markern, aber endet davor",
}
"""English pattern -> German pattern."""

PHRASES = {
    "file without suffix": "eine Datei ohne Endung",
    "file without a suffix": "eine Datei ohne Endung",
    "the disk is full": "die Platte ist voll",
    "shape {}": "Form {}",
    "point {}": "Punkt {}",
    "part {}": "Teil {}",
    " and {} more": " und {} weitere",
    "an ARKit CSV table": "eine ARKit-CSV-Tabelle",
    "a BVH file": "eine BVH-Datei",
    "a C3D file": "eine C3D-Datei",
    "a FAP stream": "ein FAP-Strom",
    "a CSV table of markers": "eine CSV-Tabelle mit Markern",
    "a CSV table of ARKit weights or markers": "eine CSV-Tabelle mit ARKit-Gewichten oder Markern",
    "a TRC marker table": "eine TRC-Markertabelle",
}
"""The same for what stands in such a sentence as a value."""
