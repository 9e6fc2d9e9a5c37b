"""German, in Blender's own words, which an artist sees around ours.

Glossary
--------
shape key : Formschlüssel        vertex group : Punktgruppe      vertex : Eckpunkt (a Punkt is a feature point)
mesh : Masche                    base mesh : Basismasche         UV map, normal map : UV-Map, Normalmap
frame : Bild, in its compounds   bake : backen                   cache : Zwischenspeicher
driver : Treiber                 modifier : Modifikator          Sculpt Mode : Skulpturmodus
retarget : übertragen            feature point : Merkmalspunkt   performance : Darbietung
clone : klonen                   sculpt : formen                 rough out : anlegen
gain : Stärke                    level : Stufe                   job : Auftrag

Nobody is addressed: buttons, and what asks for something, stand in the infinitive.
"""

from . import core, export, files, guide, operators, panels, points, properties, sentences, settings, wrinkles

PARTS = (guide, panels, operators, export, properties, settings, points, wrinkles)

TEXTS: dict[str, str] = {english: german for part in PARTS for english, german in part.TEXTS.items()}
"""English text -> German text, with the same {fields}."""

SAYING = (sentences, core, export, files, wrinkles)

SENTENCES: dict[str, str] = {english: german for part in SAYING for english, german in part.SENTENCES.items()}
"""English pattern -> German pattern, as `translations.sentences` wants them."""

PHRASES: dict[str, str] = points.TEXTS | {
    english: german for part in SAYING for english, german in getattr(part, "PHRASES", {}).items()
}
"""The same for what is only said as a value."""
