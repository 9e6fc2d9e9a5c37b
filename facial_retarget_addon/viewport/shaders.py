"""Shaders of our own: marks of a size in pixels that face the viewer, told apart by shape, on every GPU backend.

Blender draws into sRGB framebuffers: colours go to the shaders linear, see `linear`.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

import gpu
import numpy as np
from gpu.types import GPUShader, GPUShaderCreateInfo, GPUStageInterfaceInfo
from mathutils import Color

from ..core.arrays import FloatArray

REACH = 2.0
"""A mark's square reaches this many radii from its middle."""

_MARK_VERTEX = """
void main()
{
  vec4 place = matrix * vec4(pos, 1.0);
  radius = (abs(row - hot) < 0.5) ? 1.3 * size : size;
  /* Two radii toward the viewer, so that the surface around a mark does not cut into it. */
  float nearer = 4.0 * radius * place.w / (viewport.y * lens.x);
  float depth = (place.z + lens.y * nearer) / max(place.w + lens.z * nearer, 1e-6);
  uv = corner;
  tint = look;
  gl_Position = vec4(place.xy + corner * radius * 2.0 / viewport * place.w, max(depth, -1.0) * place.w, place.w);
}
"""

_LINE_VERTEX = """
void main()
{
  vec4 one = matrix * vec4(start, 1.0);
  vec4 other = matrix * vec4(end, 1.0);
  vec4 place = mix(one, other, side.x);
  vec2 along = (other.xy / other.w - one.xy / one.w) * viewport;
  float far = length(along);
  vec2 across = (far > 1e-6) ? vec2(-along.y, along.x) / far : vec2(0.0);
  off = side.y * (0.5 * width + 1.5);
  /* Toward the viewer by some pixels, so that the surface beside a line does not cut into it. */
  float nearer = 8.0 * place.w / (viewport.y * lens.x);
  float depth = (place.z + lens.y * nearer) / max(place.w + lens.z * nearer, 1e-6);
  gl_Position = vec4(place.xy + across * off * 2.0 / viewport * place.w, max(depth, -1.0) * place.w, place.w);
}
"""

_LINE_FRAGMENT = """
void main()
{
  float core = clamp(0.5 * width + 0.5 - abs(off), 0.0, 1.0);
  float edge = 0.5 * clamp(0.5 * width + 1.5 - abs(off), 0.0, 1.0);
  vec4 paint = vec4(vec3(0.004), 1.0) * edge;
  fragColor = (paint * (1.0 - core) + vec4(colour, 1.0) * core) * strength;
}
"""

_HEAT_VERTEX = """
void main()
{
  vec4 place = matrix * vec4(pos, 1.0);
  heat = value;
  /* Toward the viewer by a pixel or two, or the surface would show through in spots. */
  float nearer = 3.0 * place.w / (viewport.y * lens.x);
  float depth = (place.z + lens.y * nearer) / max(place.w + lens.z * nearer, 1e-6);
  gl_Position = vec4(place.xy, max(depth, -1.0) * place.w, place.w);
}
"""

RAMP = ((1.0, 0.93, 0.35), (1.0, 0.62, 0.10), (0.90, 0.16, 0.10), (0.45, 0.0, 0.35))
"""Colours of the heat map from little to much, as they are picked on a screen: each is darker than the one before."""

_HEAT_FRAGMENT = """
void main()
{
  float share = clamp((heat - low) / (high - low), 0.0, 1.0);
  float alpha = 0.8 * clamp(share / 0.25, 0.0, 1.0);
  if (!(alpha > 0.01)) {
    discard;
  }
  float place = 3.0 * share;
  vec3 colour = mix(mix(mix(RAMP_0, RAMP_1, clamp(place, 0.0, 1.0)), RAMP_2, clamp(place - 1.0, 0.0, 1.0)), RAMP_3,
                    clamp(place - 2.0, 0.0, 1.0));
  fragColor = vec4(colour * alpha, alpha);
}
"""

_MARK_FRAGMENT = """
vec4 paint;

float cover(float distance_in_radii)
{
  return clamp(0.5 - distance_in_radii * radius, 0.0, 1.0);
}

void layer(vec3 colour, float share)
{
  paint = paint * (1.0 - share) + vec4(colour, 1.0) * share;
}

float triangle(vec2 at, float half_side)
{
  const float slope = 1.7320508;
  at.x = abs(at.x) - half_side;
  at.y = at.y + half_side / slope;
  if (at.x + slope * at.y > 0.0) {
    at = vec2(at.x - slope * at.y, -slope * at.x - at.y) / 2.0;
  }
  at.x -= clamp(at.x, -2.0 * half_side, 0.0);
  return -length(at) * sign(at.y);
}

void main()
{
  const vec3 dark = vec3(0.004);
  const vec3 light = vec3(0.95);
  paint = vec4(0.0);
  float away = length(uv);
  int shape = int(tint.w + 0.5);
  if (shape == 0) {  /* placed: a disc */
    layer(dark, 0.8 * cover(away - 1.3));
    layer(tint.rgb, cover(away - 0.95));
  }
  else if (shape == 1) {  /* proposed: a ring */
    float band = abs(away - 1.0);
    layer(dark, 0.8 * cover(band - 0.5));
    layer(tint.rgb, cover(band - 0.2));
  }
  else if (shape == 2) {  /* selected: a light disc in a ring */
    layer(dark, 0.8 * cover(away - 1.95));
    layer(tint.rgb, cover(away - 1.65));
    layer(dark, cover(away - 1.2));
    layer(light, cover(away - 0.9));
  }
  else if (shape == 4) {  /* proposed, and its turn: a ring with four ticks */
    float band = abs(away - 0.95);
    vec2 off = abs(uv);
    float tick = max(min(off.x, off.y) - 0.16, abs(max(off.x, off.y) - 1.5) - 0.4);
    layer(dark, 0.8 * cover(min(band - 0.5, tick - 0.25)));
    layer(tint.rgb, cover(min(band - 0.25, tick)));
  }
  else {  /* doubtful: a warning triangle with its exclamation mark */
    float edge = triangle(uv + vec2(0.0, 0.15), 1.15);
    layer(dark, 0.8 * cover(edge - 0.6));
    layer(tint.rgb, cover(edge - 0.25));
    vec2 bar = abs(uv - vec2(0.0, 0.25)) - vec2(0.02, 0.4);
    layer(dark, cover(length(max(bar, 0.0)) - 0.17));
    layer(dark, cover(length(uv - vec2(0.0, -0.62)) - 0.2));
  }
  fragColor = paint * strength;
}
"""


def linear(red: float, green: float, blue: float) -> tuple[float, float, float]:
    """A colour as it is picked on a screen, as the shaders want it."""
    return tuple(Color((red, green, blue)).from_srgb_to_scene_linear())


@cache
def mark_shader() -> GPUShader:
    """Marks at `pos`: `corner` (-REACH to REACH) of their square, `look` (linear colour, shape), `row` of the mark."""
    info = GPUShaderCreateInfo()
    info.push_constant("MAT4", "matrix")
    info.push_constant("VEC3", "lens")
    info.push_constant("VEC2", "viewport")
    info.push_constant("FLOAT", "size")
    info.push_constant("FLOAT", "hot")
    info.push_constant("FLOAT", "strength")
    info.vertex_in(0, "VEC3", "pos")
    info.vertex_in(1, "VEC2", "corner")
    info.vertex_in(2, "VEC4", "look")
    info.vertex_in(3, "FLOAT", "row")
    passed = GPUStageInterfaceInfo("facial_retarget_mark")
    passed.smooth("VEC2", "uv")
    passed.flat("VEC4", "tint")
    passed.flat("FLOAT", "radius")
    info.vertex_out(passed)
    info.fragment_out(0, "VEC4", "fragColor")
    info.vertex_source(_MARK_VERTEX)
    info.fragment_source(_MARK_FRAGMENT)
    return gpu.shader.create_from_info(info)


@cache
def line_shader() -> GPUShader:
    """Lines from `start` to `end`: `side` says which end, 0 or 1, and which side of the line, -1 or 1."""
    info = GPUShaderCreateInfo()
    info.push_constant("MAT4", "matrix")
    info.push_constant("VEC3", "lens")
    info.push_constant("VEC3", "colour")
    info.push_constant("VEC2", "viewport")
    info.push_constant("FLOAT", "width")
    info.push_constant("FLOAT", "strength")
    info.vertex_in(0, "VEC3", "start")
    info.vertex_in(1, "VEC3", "end")
    info.vertex_in(2, "VEC2", "side")
    passed = GPUStageInterfaceInfo("facial_retarget_line")
    passed.no_perspective("FLOAT", "off")
    info.vertex_out(passed)
    info.fragment_out(0, "VEC4", "fragColor")
    info.vertex_source(_LINE_VERTEX)
    info.fragment_source(_LINE_FRAGMENT)
    return gpu.shader.create_from_info(info)


@cache
def heat_shader() -> GPUShader:
    """Triangles at `pos` whose colour says the `value` between `low` and `high`; below `low` nothing is drawn."""
    info = GPUShaderCreateInfo()
    info.push_constant("MAT4", "matrix")
    info.push_constant("VEC3", "lens")
    info.push_constant("VEC2", "viewport")
    info.push_constant("FLOAT", "low")
    info.push_constant("FLOAT", "high")
    info.vertex_in(0, "VEC3", "pos")
    info.vertex_in(1, "FLOAT", "value")
    passed = GPUStageInterfaceInfo("facial_retarget_heat")
    passed.smooth("FLOAT", "heat")
    info.vertex_out(passed)
    for number, colour in enumerate(RAMP):
        info.define(f"RAMP_{number}", "vec3({:.5f}, {:.5f}, {:.5f})".format(*linear(*colour)))
    info.fragment_out(0, "VEC4", "fragColor")
    info.vertex_source(_HEAT_VERTEX)
    info.fragment_source(_HEAT_FRAGMENT)
    return gpu.shader.create_from_info(info)


@contextmanager
def drawing(depth_test: str, writes_depth: bool = False) -> Iterator[None]:
    """Draw what is premultiplied by its alpha; then the state is as it was.

    Parameters
    ----------
    depth_test : as `gpu.state.depth_test_set` has it.
    writes_depth : whether it hides what is drawn later; what is clear in places must not.
    """
    test, writes = gpu.state.depth_test_get(), gpu.state.depth_mask_get()
    gpu.state.blend_set("ALPHA_PREMULT")
    gpu.state.depth_test_set(depth_test)
    gpu.state.depth_mask_set(writes_depth)
    try:
        yield
    finally:
        gpu.state.depth_mask_set(writes)
        gpu.state.depth_test_set(test)
        gpu.state.blend_set("NONE")


def lens(projection: FloatArray) -> tuple[float, float, float]:
    """What moves a place (4,) of clip space toward the viewer, of a projection matrix (4, 4)."""
    matrix = np.asarray(projection)
    return float(matrix[1, 1]), float(matrix[2, 2]), float(matrix[3, 2])
