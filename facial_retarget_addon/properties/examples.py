"""Example expressions, and how far they are."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty
from bpy.types import Object, PropertyGroup

EXAMPLE_STATES = [
    ("MISSING", "Missing", "The face has no shape key of this name", "X", 0),
    ("EMPTY", "Not Sculpted", "The shape key equals the Basis: the example is left out", "RADIOBUT_OFF", 1),
    ("SCULPTED", "Sculpted", "The shape key moves the face", "RADIOBUT_ON", 2),
]


class FACIAL_RETARGET_PG_example(PropertyGroup):
    """An example expression: the shape key of this name on both faces. `name` is inherited."""

    def _state(self, side: str) -> str:
        """What `bridge.example_states` says of the example."""
        from ..bridge.examples.example_states import states_of

        state = states_of(self.id_data.facial_retarget).get(self.name)
        return "" if state is None else getattr(state, side)

    def _source_state(self) -> int:
        return _STATE_NUMBERS.get(self._state("source"), 0)

    def _target_state(self) -> int:
        return _STATE_NUMBERS.get(self._state("target"), 0)

    def _warning(self) -> str:
        return self._state("warning")

    def _checked(self) -> bool:
        from ..bridge.examples.example_states import stamp_of

        task = self.id_data.facial_retarget
        return self.fit >= 0 and task.examples_checked == stamp_of(task)

    source_state: EnumProperty(
        name="On the Source", items=EXAMPLE_STATES, get=_source_state, description="How far the example is there"
    )
    target_state: EnumProperty(
        name="On the Target", items=EXAMPLE_STATES, get=_target_state, description="How far the example is there"
    )
    warning: StringProperty(name="Warning", get=_warning, description="What is wrong with the example")
    fit: FloatProperty(
        name="Fit", default=-1.0, description="Share of the example's motion that the method misses; -1 if not checked"
    )
    leave_one_out: FloatProperty(
        name="Without It",
        default=-1.0,
        description="Share of the example's motion that would be missing if only the others were known",
    )
    checked: BoolProperty(
        name="Checked", get=_checked, description="Whether its figures are those of the examples as they are now"
    )


_STATE_NUMBERS = {state[0]: state[-1] for state in EXAMPLE_STATES}


class FACIAL_RETARGET_PG_sculpting(PropertyGroup):
    """The example that is being sculpted, and what is to be as it was afterwards."""

    thing: PointerProperty(name="Object", type=Object, description="The object in Sculpt Mode")
    example: StringProperty(name="Example", description="Its name")
    side: StringProperty(name="Face", description="SOURCE or TARGET")
    before: PointerProperty(name="Active Object", type=Object, description="The object that was active before")
    key: StringProperty(name="Shape Key", description="The shape key that was active before")
    pinned: BoolProperty(name="Pinned", description="Whether it alone was shown before")


CLASSES = (
    FACIAL_RETARGET_PG_example,
    FACIAL_RETARGET_PG_sculpting,
)
