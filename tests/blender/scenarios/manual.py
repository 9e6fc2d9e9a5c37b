"""The manual ships with the extension; Blender's Online Manual and our buttons open the right place of it."""

import webbrowser
from urllib.parse import urlparse
from urllib.request import url2pathname

import bpy
from stage import NAME, disable, enable, part

opened: list[str] = []
webbrowser.open = lambda url, *more: bool(opened.append(url)) or True
enable()
manual = part("manual")


def check_page(url: str, wanted: str) -> None:
    """The address is the place wanted, and the page has it."""
    assert url.endswith(f"/manual/{wanted}"), (url, wanted)
    address = urlparse(url)
    with open(url2pathname(address.path), encoding="utf-8") as file:
        assert f'id="{address.fragment}"' in file.read(), url


def online_manual(identifier: str) -> str:
    """What Blender opens for an operator or a property."""
    opened.clear()
    assert bpy.ops.wm.doc_view_manual(doc_id=identifier) == {"FINISHED"}, identifier
    return opened[0]


def own(kind: type) -> list[str]:
    """The properties that a group declares; to Blender every group's name is that of all groups."""
    declared = getattr(kind, "__annotations__", ()) if issubclass(kind, bpy.types.PropertyGroup) else ()
    return [name for name in declared if name != "name"]


assert bpy.ops.facial_retarget.open_manual(page=manual.STEPS["REPORT"]) == {"FINISHED"}
check_page(opened[0], "blender.html#6-report")

for identifier, page in {
    "facial_retarget.retarget": manual.STEPS["RETARGET"],
    "facial_retarget.place_point": manual.STEPS["POINTS"],
    "facial_retarget.add_example": manual.STEPS["EXAMPLES"],
    "facial_retarget.save_job": manual.STEPS["EXPORT"],
    "facial_retarget.save_clone_job": manual.CLONING,
    "facial_retarget.clone_shapes": manual.CLONING,
    "facial_retarget.make_shapes": manual.MPEG4,
    "facial_retarget.import_motion": manual.MPEG4,
    "FACIAL_RETARGET_PG_task.source": manual.STEPS["FACES"],
    "FACIAL_RETARGET_PG_face.point_set": manual.STEPS["POINTS"],
    "FACIAL_RETARGET_PG_hierarchical.levels": manual.STEPS["RETARGET"],
    "FACIAL_RETARGET_PG_cloning.keep": manual.CLONING,
}.items():
    check_page(online_manual(identifier), page)

# Everything of ours leads somewhere, and every pattern is of use.
prefix, patterns = manual.manual_map()
met = set()
ours = [kind for base in (bpy.types.Operator, bpy.types.PropertyGroup) for kind in base.__subclasses__()]
names = [kind.bl_idname for kind in ours if getattr(kind, "bl_idname", "").startswith("facial_retarget.")]
names += [f"{kind.__name__}.{name}" for kind in ours if kind.__module__.startswith(NAME) for name in own(kind)]
for name in names:
    url = online_manual(name)
    check_page(url, url.rpartition("/")[2])
    met.add(url)
assert met == {prefix + page for _, page in patterns if "6-report" not in page}, met

disable()
assert not [found for found, _ in bpy.utils.manual_map() if found == prefix]
