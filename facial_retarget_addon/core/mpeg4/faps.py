"""The 68 Facial Animation Parameters of MPEG-4 (ISO/IEC 14496-2), as plain data.

Axes are the head's: x to the subject's left, y up, z the way the face looks.
"""

from __future__ import annotations

from dataclasses import dataclass

X, Y, Z = 0, 1, 2
"""The head's axes."""


@dataclass(frozen=True)
class Fap:
    """A Facial Animation Parameter.

    Attributes
    ----------
    number : 1 to 68.
    name : the standard's.
    meaning : what moves, and where to as the value grows. Inner and outer are the two edges of the lips' red.
    unit : IRISD, ES, ENS, MNS, MW (1/1024 of a length of the face), AU (1e-5 rad), or "" for none.
    kind : high_level, translation, rotation (right-handed about the axis), scale, or roll.
    points : FDPs that it moves.
    axis : 0, 1 or 2 of the head's axes, or None.
    sign : whether a growing value moves along the axis or against it.
    one_way : values below zero have no meaning.
    mirror : the FAP of the other half of the face, itself on the middle line.
    mirror_sign : what its value is multiplied by when the face is mirrored.
    """

    number: int
    name: str
    meaning: str
    unit: str
    kind: str
    points: tuple[str, ...]
    axis: int | None
    sign: int
    one_way: bool
    mirror: int
    mirror_sign: int


FAPS: tuple[Fap, ...] = (
    Fap(1, "viseme", "two of the 14 visemes, mixed", "", "high_level", (), None, 1, False, 1, 1),
    Fap(2, "expression", "two of the six expressions, mixed", "", "high_level", (), None, 1, False, 2, 1),
    Fap(3, "open_jaw", "chin's bottom: down; lips stay", "MNS", "translation", ("2.1",), Y, -1, True, 3, 1),
    Fap(4, "lower_t_midlip", "inner upper lip, middle: down", "MNS", "translation", ("2.2",), Y, -1, False, 4, 1),
    Fap(5, "raise_b_midlip", "inner lower lip, middle: up", "MNS", "translation", ("2.3",), Y, 1, False, 5, 1),
    Fap(6, "stretch_l_cornerlip", "inner left corner: left", "MW", "translation", ("2.4",), X, 1, False, 7, 1),
    Fap(7, "stretch_r_cornerlip", "inner right corner: right", "MW", "translation", ("2.5",), X, -1, False, 6, 1),
    Fap(8, "lower_t_lip_lm", "inner upper lip, left: down", "MNS", "translation", ("2.6",), Y, -1, False, 9, 1),
    Fap(9, "lower_t_lip_rm", "inner upper lip, right: down", "MNS", "translation", ("2.7",), Y, -1, False, 8, 1),
    Fap(10, "raise_b_lip_lm", "inner lower lip, left: up", "MNS", "translation", ("2.8",), Y, 1, False, 11, 1),
    Fap(11, "raise_b_lip_rm", "inner lower lip, right: up", "MNS", "translation", ("2.9",), Y, 1, False, 10, 1),
    Fap(12, "raise_l_cornerlip", "inner left corner: up", "MNS", "translation", ("2.4",), Y, 1, False, 13, 1),
    Fap(13, "raise_r_cornerlip", "inner right corner: up", "MNS", "translation", ("2.5",), Y, 1, False, 12, 1),
    Fap(14, "thrust_jaw", "chin's bottom: forward", "MNS", "translation", ("2.1",), Z, 1, True, 14, 1),
    Fap(15, "shift_jaw", "chin's bottom: right", "MW", "translation", ("2.1",), X, -1, False, 15, -1),
    Fap(16, "push_b_lip", "lower lip, middle: forward", "MNS", "translation", ("2.3",), Z, 1, False, 16, 1),
    Fap(17, "push_t_lip", "upper lip, middle: forward", "MNS", "translation", ("2.2",), Z, 1, False, 17, 1),
    Fap(18, "depress_chin", "chin's boss: up, squeezing it", "MNS", "translation", ("2.10",), Y, 1, False, 18, 1),
    Fap(19, "close_t_l_eyelid", "upper left lid: down", "IRISD", "translation", ("3.1",), Y, -1, False, 20, 1),
    Fap(20, "close_t_r_eyelid", "upper right lid: down", "IRISD", "translation", ("3.2",), Y, -1, False, 19, 1),
    Fap(21, "close_b_l_eyelid", "lower left lid: up", "IRISD", "translation", ("3.3",), Y, 1, False, 22, 1),
    Fap(22, "close_b_r_eyelid", "lower right lid: up", "IRISD", "translation", ("3.4",), Y, 1, False, 21, 1),
    Fap(23, "yaw_l_eyeball", "left eye: turns left", "AU", "rotation", ("3.5",), Y, 1, False, 24, -1),
    Fap(24, "yaw_r_eyeball", "right eye: turns left", "AU", "rotation", ("3.6",), Y, 1, False, 23, -1),
    Fap(25, "pitch_l_eyeball", "left eye: turns down", "AU", "rotation", ("3.5",), X, 1, False, 26, 1),
    Fap(26, "pitch_r_eyeball", "right eye: turns down", "AU", "rotation", ("3.6",), X, 1, False, 25, 1),
    Fap(27, "thrust_l_eyeball", "left eye: forward", "ES", "translation", ("3.5",), Z, 1, False, 28, 1),
    Fap(28, "thrust_r_eyeball", "right eye: forward", "ES", "translation", ("3.6",), Z, 1, False, 27, 1),
    Fap(29, "dilate_l_pupil", "left pupil: wider", "IRISD", "scale", ("3.5",), None, 1, False, 30, 1),
    Fap(30, "dilate_r_pupil", "right pupil: wider", "IRISD", "scale", ("3.6",), None, 1, False, 29, 1),
    Fap(31, "raise_l_i_eyebrow", "left brow, inner end: up", "ENS", "translation", ("4.1",), Y, 1, False, 32, 1),
    Fap(32, "raise_r_i_eyebrow", "right brow, inner end: up", "ENS", "translation", ("4.2",), Y, 1, False, 31, 1),
    Fap(33, "raise_l_m_eyebrow", "left brow, middle: up", "ENS", "translation", ("4.3",), Y, 1, False, 34, 1),
    Fap(34, "raise_r_m_eyebrow", "right brow, middle: up", "ENS", "translation", ("4.4",), Y, 1, False, 33, 1),
    Fap(35, "raise_l_o_eyebrow", "left brow, outer end: up", "ENS", "translation", ("4.5",), Y, 1, False, 36, 1),
    Fap(36, "raise_r_o_eyebrow", "right brow, outer end: up", "ENS", "translation", ("4.6",), Y, 1, False, 35, 1),
    Fap(37, "squeeze_l_eyebrow", "left brow: towards the nose", "ES", "translation", ("4.1",), X, -1, False, 38, 1),
    Fap(38, "squeeze_r_eyebrow", "right brow: towards the nose", "ES", "translation", ("4.2",), X, 1, False, 37, 1),
    Fap(39, "puff_l_cheek", "left cheek: left, puffed", "ES", "translation", ("5.1",), X, 1, False, 40, 1),
    Fap(40, "puff_r_cheek", "right cheek: right, puffed", "ES", "translation", ("5.2",), X, -1, False, 39, 1),
    Fap(41, "lift_l_cheek", "left cheek bone's skin: up", "ENS", "translation", ("5.3",), Y, 1, True, 42, 1),
    Fap(42, "lift_r_cheek", "right cheek bone's skin: up", "ENS", "translation", ("5.4",), Y, 1, True, 41, 1),
    Fap(43, "shift_tongue_tip", "tongue's tip: right", "MW", "translation", ("6.1",), X, -1, False, 43, -1),
    Fap(44, "raise_tongue_tip", "tongue's tip: up", "MNS", "translation", ("6.1",), Y, 1, False, 44, 1),
    Fap(45, "thrust_tongue_tip", "tongue's tip: forward", "MW", "translation", ("6.1",), Z, 1, False, 45, 1),
    Fap(46, "raise_tongue", "tongue's body: up", "MNS", "translation", ("6.2",), Y, 1, False, 46, 1),
    Fap(47, "tongue_roll", "tongue's edges: up, a gutter", "AU", "roll", ("6.3", "6.4"), None, 1, True, 47, 1),
    Fap(48, "head_pitch", "head: nods down", "AU", "rotation", ("7.1",), X, 1, False, 48, 1),
    Fap(49, "head_yaw", "head: turns left", "AU", "rotation", ("7.1",), Y, 1, False, 49, -1),
    Fap(50, "head_roll", "head: tilts to the right", "AU", "rotation", ("7.1",), Z, 1, False, 50, -1),
    Fap(51, "lower_t_midlip_o", "outer upper lip, middle: down", "MNS", "translation", ("8.1",), Y, -1, False, 51, 1),
    Fap(52, "raise_b_midlip_o", "outer lower lip, middle: up", "MNS", "translation", ("8.2",), Y, 1, False, 52, 1),
    Fap(53, "stretch_l_cornerlip_o", "outer left corner: left", "MW", "translation", ("8.3",), X, 1, False, 54, 1),
    Fap(54, "stretch_r_cornerlip_o", "outer right corner: right", "MW", "translation", ("8.4",), X, -1, False, 53, 1),
    Fap(55, "lower_t_lip_lm_o", "outer upper lip, left: down", "MNS", "translation", ("8.5",), Y, -1, False, 56, 1),
    Fap(56, "lower_t_lip_rm_o", "outer upper lip, right: down", "MNS", "translation", ("8.6",), Y, -1, False, 55, 1),
    Fap(57, "raise_b_lip_lm_o", "outer lower lip, left: up", "MNS", "translation", ("8.7",), Y, 1, False, 58, 1),
    Fap(58, "raise_b_lip_rm_o", "outer lower lip, right: up", "MNS", "translation", ("8.8",), Y, 1, False, 57, 1),
    Fap(59, "raise_l_cornerlip_o", "outer left corner: up", "MNS", "translation", ("8.3",), Y, 1, False, 60, 1),
    Fap(60, "raise_r_cornerlip_o", "outer right corner: up", "MNS", "translation", ("8.4",), Y, 1, False, 59, 1),
    Fap(61, "stretch_l_nose", "left nostril: left, wider", "ENS", "translation", ("9.1",), X, 1, False, 62, 1),
    Fap(62, "stretch_r_nose", "right nostril: right, wider", "ENS", "translation", ("9.2",), X, -1, False, 61, 1),
    Fap(63, "raise_nose", "nose's tip: up", "ENS", "translation", ("9.3",), Y, 1, False, 63, 1),
    Fap(64, "bend_nose", "nose's tip: right", "ENS", "translation", ("9.3",), X, -1, False, 64, -1),
    Fap(65, "raise_l_ear", "left ear's top: up", "ENS", "translation", ("10.1",), Y, 1, False, 66, 1),
    Fap(66, "raise_r_ear", "right ear's top: up", "ENS", "translation", ("10.2",), Y, 1, False, 65, 1),
    Fap(67, "pull_l_ear", "left ear: left, off the head", "ENS", "translation", ("10.3",), X, 1, False, 68, 1),
    Fap(68, "pull_r_ear", "right ear: right, off the head", "ENS", "translation", ("10.4",), X, -1, False, 67, 1),
)
"""All of them; FAP n is FAPS[n - 1], and column n - 1 wherever FAPs are columns."""

HEAD_TURNS = slice(47, 50)
"""Columns of FAPs 48 to 50, which turn the head as a whole."""
