"""One transform as text for other programs: URDF's origin, static_transform_publisher's options."""

from tftool.geometry.conversions import precise_rpy_from_quaternion
from tftool.geometry.rigid import Transform


def exact(number: float) -> str:
    """Format a number with the fewest digits that identify it; -0 becomes "0"."""
    text = repr(float(number) + 0.0)
    return text.removesuffix(".0")


def urdf_origin(transform: Transform) -> str:
    """Return URDF's `<origin>` element of a transform, exact to 1e-12."""
    xyz = " ".join(map(exact, transform.translation))
    rpy = " ".join(map(exact, precise_rpy_from_quaternion(transform.rotation)))
    return f'<origin xyz="{xyz}" rpy="{rpy}"/>'


def publisher_words(transform: Transform) -> list[str]:
    """Return static_transform_publisher's options for a transform, with the exact quaternion."""
    names = ("x", "y", "z", "qx", "qy", "qz", "qw")
    numbers = (*transform.translation, *transform.rotation)
    return [
        word
        for name, number in zip(names, numbers, strict=True)
        for word in (f"--{name}", exact(number))
    ]
