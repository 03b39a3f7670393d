"""Random values for hypothesis: rotations, poses, stamps."""

import math

from hypothesis import strategies as st

from tftool.geometry import quaternions
from tftool.geometry.rigid import Quaternion, Transform, Vector3

numbers = st.floats(-100.0, 100.0)
vectors = st.builds(Vector3, numbers, numbers, numbers)
angles = st.floats(-math.pi, math.pi)


def _turn(parts: tuple[float, float, float, float]) -> Quaternion:
    return Quaternion(*quaternions.unit(parts))


parts = st.floats(-1.0, 1.0)
rotations = (
    st.tuples(parts, parts, parts, parts)
    .filter(lambda four: sum(part * part for part in four) > 1e-3)
    .map(_turn)
)
"""Random unit quaternions, of either sign."""

transforms = st.builds(Transform, vectors, rotations)
fractions = st.floats(0.0, 1.0)
