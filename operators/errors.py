"""The one place where bad input becomes a message: a red report, and nothing is changed."""

from collections.abc import Callable
from functools import wraps

from bpy.types import Context, Operator

from ..facial_retarget_addon.core.errors import RetargetError
from ..facial_retarget_addon.translations import told

Method = Callable[[Operator, Context], set[str]]


def tells_user(method: Method) -> Method:
    """An operator's method, with RetargetError reported and the operator cancelled. Anything else is a bug."""

    # Blender counts the arguments of what it calls: no *args here.
    @wraps(method)
    def guarded(self: Operator, context: Context) -> set[str]:
        try:
            return method(self, context)
        except RetargetError as error:
            self.report({"ERROR"}, told(str(error)))
            return {"CANCELLED"}

    return guarded
