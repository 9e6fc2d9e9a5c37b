"""Install the zip and check that it is there: the operator says FINISHED even when it has failed."""

import sys

import bpy

bpy.ops.extensions.package_install_files(filepath=sys.argv[1], repo="user_default", enable_on_install=True)
assert "bl_ext.user_default.facial_retarget" in bpy.context.preferences.addons, "the extension is not enabled"
assert hasattr(bpy.types.Scene, "facial_retarget"), "the extension is enabled, but not registered"
