"""The retargeting methods: one module each, and one line here.

Plain data, so that a panel can list them without loading SciPy.
"""

METHODS: dict[str, str] = {
    "hierarchical": "Hierarchical (Na & Jung): dense motion by correspondence, level by level, with examples",
    "feature_points": "Feature points (Kshirsagar et al.): MPEG-4 points drive the surface, in each face's own units",
    "motion_cloning": "Motion cloning (Pandzic): every shape of a head onto another, in each face's own units",
    "wavelet": "Wavelet (Min & Jung): dense motion in subdivision wavelets, details turned with the target",
}
"""Method name, as in job files -> what an artist reads. The module of the same name has `fit`."""
