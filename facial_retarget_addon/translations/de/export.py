"""Heads out of Blender: the exporters, and what is lost."""

TEXTS = {
    "Prepare for Export": "Für Export vorbereiten",
    "Copy the target's head for any exporter: plain shape keys without drivers, each with a curve; Esc stops": (
        "Den Kopf des Ziels für beliebige Exporter kopieren: schlichte Formschlüssel ohne Treiber, jeder mit einer "
        "Kurve; Esc hält an"
    ),
    "Preparing": "Bereitet vor",
    "Samples": "Abtastwerte",
    "How often each frame is sampled; 0 for as often as the keyframes between frames ask for": (
        "Wie oft jedes Bild abgetastet wird; 0 für so oft, wie die Schlüsselbilder zwischen den Bildern verlangen"
    ),
    "Only Without Loss": "Nur ohne Verlust",
    "Write nothing if the format loses something": "Nichts schreiben, wenn das Format etwas verliert",
    "Export FBX": "FBX exportieren",
    "Export the target and the parts of its head with their shape keys and animation, by Blender's FBX exporter": (
        "Das Ziel und die Teile seines Kopfes mit Formschlüsseln und Animation exportieren, mit Blenders FBX-Exporter"
    ),
    "Enable the add-on FBX Format in the preferences": "Das Add-on „FBX format“ in den Einstellungen einschalten",
    "Export USD": "USD exportieren",
    "Export the target and the parts of its head, by Blender's USD exporter": (
        "Das Ziel und die Teile seines Kopfes exportieren, mit Blenders USD-Exporter"
    ),
    "This Blender was built without USD": "Dieses Blender wurde ohne USD gebaut",
    "Export Alembic": "Alembic exportieren",
    "Export the target and the parts of its head as moving vertices, by Blender's Alembic exporter": (
        "Das Ziel und die Teile seines Kopfes als bewegte Eckpunkte exportieren, mit Blenders Alembic-Exporter"
    ),
    "This Blender was built without Alembic": "Dieses Blender wurde ohne Alembic gebaut",
    "The format of the file": "Das Format der Datei",
    "glTF": "glTF",
    "FBX": "FBX",
    "USD": "USD",
    "Alembic": "Alembic",
    "Shape keys and their animation, for engines and the web": (
        "Formschlüssel und ihre Animation, für Spiele-Engines und das Web"
    ),
    "Shape keys and their animation, for engines and animation programs": (
        "Formschlüssel und ihre Animation, für Spiele-Engines und Animationsprogramme"
    ),
    "Shape keys and their animation, or moving vertices, for film pipelines": (
        "Formschlüssel und ihre Animation, oder bewegte Eckpunkte, für Film-Pipelines"
    ),
    "Moving vertices, whatever moves them, for film pipelines": (
        "Bewegte Eckpunkte, was auch immer sie bewegt, für Film-Pipelines"
    ),
    "Moving Vertices": "Bewegte Eckpunkte",
    "USD gets where the vertices are at each frame, whatever moves them, instead of shape keys": (
        "USD bekommt statt Formschlüsseln, wo die Eckpunkte bei jedem Bild sind, was auch immer sie bewegt"
    ),
    "Write where the vertices are at each frame, whatever moves them, instead of shape keys": (
        "Statt Formschlüsseln schreiben, wo die Eckpunkte bei jedem Bild sind, was auch immer sie bewegt"
    ),
    "Prepared From": "Vorbereitet aus",
    "What this copy was prepared from": "Woraus diese Kopie vorbereitet wurde",
    # What is lost.
    "Only the scene's frames {first} to {last} are exported: the keyframes reach from {start:g} to {end:g}": (
        "Nur die Bilder {first} bis {last} der Szene werden exportiert: die Schlüsselbilder reichen von {start:g} bis "
        "{end:g}"
    ),
    "Keyframes that lie between the samples are left out": "Schlüsselbilder zwischen den Abtastungen fallen weg",
    "Shape keys become moving vertices, without sliders: {names}": (
        "Formschlüssel werden zu bewegten Eckpunkten, ohne Regler: {names}"
    ),
    "The motion that {modifier} plays on {thing} is lost: {form} takes shape keys only. Bake some, or export moving "
    "vertices": (
        "Die Bewegung, die {modifier} auf {thing} abspielt, geht verloren: {form} nimmt nur Formschlüssel. Solche "
        "backen, oder bewegte Eckpunkte exportieren"
    ),
    "{thing} goes without what its modifiers do ({names}): they would cost it its shape keys": (
        "{thing} kommt ohne das, was seine Modifikatoren tun ({names}): sie würden die Formschlüssel kosten"
    ),
    "Nothing of {thing} will move: it has no shape keys. Retarget first": (
        "Nichts von {thing} wird sich bewegen: es hat keine Formschlüssel. Zuerst übertragen"
    ),
    "Driven shape keys become curves: {names}": "Formschlüssel mit Treibern werden zu Kurven: {names}",
    "Muted shape keys stay at 0: {names}": "Stummgeschaltete Formschlüssel bleiben auf 0: {names}",
    "The absolute shape keys of {thing} become relative ones with a curve each": (
        "Die absoluten Formschlüssel von {thing} werden relative mit je einer Kurve"
    ),
    "{form} carries values below 0 and above 1, and many programs cut them off: {names}": (
        "{form} hält Werte unter 0 und über 1, aber viele Programme kappen sie: {names}"
    ),
    "glTF makes polygons triangles and doubles vertices at the borders of UVs: their number and order change": (
        "glTF macht aus Polygonen Dreiecke und verdoppelt Eckpunkte an UV-Grenzen: Anzahl und Reihenfolge ändern sich"
    ),
    "glTF counts seconds, and Blender's importer takes this scene's {rate:.3f} frames a second for {wrong:.3f}": (
        "glTF zählt Sekunden, und Blenders Import hält die {rate:.3f} Bilder pro Sekunde dieser Szene für {wrong:.3f}"
    ),
    "Blender's newer FBX importer leaves out curves of shape keys that have a \" in their names: {names}": (
        'Blenders neuerer FBX-Import lässt Kurven von Formschlüsseln weg, die ein " im Namen haben: {names}'
    ),
    "The names of UV maps are lost": "Die Namen der UV-Maps gehen verloren",
    "USD calls objects otherwise: {names}": "USD nennt Objekte anders: {names}",
    "USD calls shape keys otherwise: {names}": "USD nennt Formschlüssel anders: {names}",
    "Alembic calls objects otherwise: {names}": "Alembic nennt Objekte anders: {names}",
    "The UV map that renders is called st, as USD's programs expect": (
        "Die UV-Map zum Rendern heißt st, wie USD-Programme es erwarten"
    ),
}

SENTENCES = {
    "absolute shape key {} of object {} is interpolated as {}, expected KEY_LINEAR: other ways cannot become relative "
    "keys": (
        "absoluter Formschlüssel {} von Objekt {} wird als {} interpoliert, erwartet wird KEY_LINEAR: anderes kann "
        "keine relativen Schlüssel geben"
    ),
    "{} is no name for {}, expected one that ends in {}": (
        "{} ist kein Name für {}, erwartet wird einer, der auf {} endet"
    ),
    "{} cannot be written: Blender's {} exporter has failed: {}": (
        "{} lässt sich nicht schreiben: Blenders {}-Exporter ist gescheitert: {}"
    ),
    "{} cannot be written: Blender's {} exporter did not get to its end; the disk may be full": (
        "{} lässt sich nicht schreiben: Blenders {}-Exporter kam nicht bis zum Ende; vielleicht ist die Festplatte voll"
    ),
    "{} cannot be written: Blender's {} exporter has written nothing": (
        "{} lässt sich nicht schreiben: Blenders {}-Exporter hat nichts geschrieben"
    ),
    "{} would lose something of {}, and nothing was written": (
        "{} würde etwas von {} verlieren: nichts wurde geschrieben"
    ),
    "Writing {}": "Schreibt {}",
    "object {} cannot be selected, expected that it can: exporters ask for it": (
        "Objekt {} lässt sich nicht auswählen; Exporter brauchen das"
    ),
    "modifier {} of object {} plays a cache by the scene's rate, expected 1 sample per frame for USD, not {}": (
        "Modifikator {} von Objekt {} spielt einen Zwischenspeicher nach der Rate der Szene, erwartet wird 1 "
        "Abtastung je Bild für USD, nicht {}"
    ),
    "scene {} maps its time to {}, expected at most {} for {} samples per frame": (
        "Szene {} dehnt ihre Zeit auf {}, erwartet wird höchstens {} bei {} Abtastungen je Bild"
    ),
    "{} objects prepared in the collection Export": "{} Objekte in der Sammlung Export vorbereitet",
    "Exported {}, frames {} to {}": "{} exportiert, Bilder {} bis {}",
}
