"""Tests of 3-D pictures: depth buffer, meshes, camera, and the cells of a terminal."""

import base64
import re
import struct
import zlib
from dataclasses import replace

import numpy as np
import pytest

from tftool.drawing import theme
from tftool.drawing.solids import coarse, solids_of
from tftool.drawing.space import OrbitCamera, SpaceFrame, SpacePicture
from tftool.drawing.space_canvas import SpaceCanvas, corners_of, rasterise
from tftool.drawing.space_file import drawn_file
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform
from tftool.robots.mesh_files import Mesh, read_mesh
from tftool.robots.mesh_folders import MeshFolders, MeshRefused
from tftool.robots.urdf import parse_description


def square(depth, size=4.0):
    corners = [
        (-size, -size, depth),
        (size, -size, depth),
        (size, size, depth),
        (-size, size, depth),
    ]
    return np.array(corners, np.float32)


HALVES = np.array([[0, 1, 2], [0, 2, 3]])


def test_the_nearer_surface_hides_the_farther_one():
    corners = np.concatenate([square(1.0), square(5.0, 2.0)])
    found = rasterise(corners, np.concatenate([HALVES + 4, HALVES]), 16, 16)

    # The large square has 8 × 8 points; the small square covers 4 × 4 of them.
    assert (found.owners >= 0).sum() == 64
    assert np.isin(found.owners, (0, 1)).sum() == 16
    assert set(found.depths[found.owners >= 0].tolist()) == {1.0, 5.0}
    assert (found.owners[6:10, 6:10] < 2).all()


def test_surfaces_that_cross_are_cut_where_they_cross():
    flat = square(0.0)
    slanted = flat + np.array([0, 0, 1], np.float32) * flat[:, :1]
    found = rasterise(np.concatenate([flat, slanted]), np.concatenate([HALVES, HALVES + 4]), 8, 8)

    assert (found.owners[:, :4] < 2).all()
    assert (found.owners[:, 4:] >= 2).all()


def test_triangles_outside_the_picture_or_with_nan_corners_are_not_drawn():
    corners = np.concatenate([square(0.0) + 100, np.full((3, 3), np.nan, np.float32)])
    found = rasterise(corners, np.array([[0, 1, 2], [4, 5, 6], [0, 0, 1]]), 8, 8)

    assert (found.owners == -1).all()


CUBE_POINTS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)


def stl(triangles):
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *np.ravel(one), 0) for one in triangles)
    return b"x" * 80 + struct.pack("<I", len(triangles)) + body


TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 2, 0]]
DAE = """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><asset>
<unit meter="0.5"/><up_axis>{up}</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique><lambert><diffuse>
<color>0 0.5 1 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="f" count="12">
0 0 0 2 0 0 2 2 0 0 2 0</float_array></source><vertices id="v"><input semantic="POSITION"
source="#p"/></vertices>{faces}</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><translate>0 0 4</translate>
<instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="c" target="#m"/></technique_common></bind_material></instance_geometry>
</node></visual_scene></library_visual_scenes></COLLADA>"""
INPUT = '<input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" offset="1"/>'
TRIANGLES = f'<triangles material="c">{INPUT}<p>0 9 1 9 2 9 0 9 2 9 3 9</p></triangles>'
POLYLIST = f'<polylist material="c">{INPUT}<vcount>4</vcount><p>0 9 1 9 2 9 3 9</p></polylist>'


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.stl", stl([TRIANGLE])),
        ("a.STL", b"solid x\nfacet\n" + b"".join(
            b"vertex %d %d %d\n" % tuple(one) for one in TRIANGLE)),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1/1 2/2 3/3\n"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 2 0\nf -3 -2 -1\n"),
    ],
)  # fmt: skip
def test_a_mesh_is_read_in_each_format(name, content):
    (mesh,) = read_mesh(name, content)

    np.testing.assert_array_equal(mesh.points[mesh.triangles[0]], TRIANGLE)


@pytest.mark.parametrize("faces", [TRIANGLES, POLYLIST])
def test_collada_has_units_an_upward_axis_places_and_colours(faces):
    (mesh,) = read_mesh("a.dae", DAE.format(up="Z_UP", faces=faces).encode())
    (turned,) = read_mesh("a.dae", DAE.format(up="Y_UP", faces=faces).encode())

    assert mesh.color == (0.0, 0.5, 1.0)
    assert len(mesh.triangles) == 2
    np.testing.assert_allclose(mesh.points[2], [1.0, 1.0, 2.0])
    np.testing.assert_allclose(turned.points[2], [1.0, -2.0, 1.0])


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("a.stl", b"nothing", "damaged"),
        ("a.obj", b"v 0 0 0\nf 1 2 3\n", "does not exist"),
        ("a.obj", b"v 0 0 nan\nv 0 0 0\nv 1 1 1\nf 1 2 3\n", "does not exist"),
        ("a.dae", b"<COLLADA", "damaged"),
        ("a.dae", b"<!DOCTYPE x><COLLADA/>", "document type"),
        ("a.glb", b"glTF", "tftool view"),
    ],
)
def test_a_damaged_mesh_is_refused_in_a_sentence(name, content, told):
    with pytest.raises(MeshRefused, match=told):
        read_mesh(name, content)


def test_a_coarse_mesh_has_fewer_triangles_and_the_same_size():
    side = np.linspace(0.0, 1.0, 101)
    points = np.array([[x, y, 0.0] for x in side for y in side])
    first = np.array([n for n in range(100 * 101) if n % 101 != 100])
    triangles = np.concatenate(
        [
            np.stack([first, first + 1, first + 102], 1),
            np.stack([first, first + 102, first + 101], 1),
        ]
    )

    found = coarse(Mesh(points, triangles), 0.05)

    assert len(found.triangles) == 2 * 20 * 20
    np.testing.assert_allclose(found.points.max(0) - found.points.min(0), [1, 1, 0], atol=0.05)


ROBOT = """<robot name="arm"><link name="base"><visual><geometry><box size="2 2 1"/></geometry>
<material name="green"><color rgba="0 1 0 1"/></material></visual></link>
<link name="ball"><collision><geometry><sphere radius="0.5"/></geometry></collision></link>
<link name="gone"><visual><geometry><mesh filename="package://none/a.stl"/></geometry></visual></link>
<link name="pin"><visual><geometry><cylinder radius="0.1" length="3"/></geometry></visual></link>
<joint name="a" type="fixed"><parent link="base"/><child link="ball"/><origin xyz="0 0 2"/></joint>
<joint name="b" type="fixed"><parent link="base"/><child link="gone"/></joint>
<joint name="c" type="fixed"><parent link="base"/><child link="pin"/></joint></robot>"""


@pytest.fixture
def picture():
    solids, refused = solids_of(parse_description(ROBOT).links.values(), MeshFolders())
    assert len(refused) == 1
    assert "package 'none'" in refused[0]
    poses = {"base": (0.0, 0.0, 0.0), "ball": (0.0, 0.0, 2.0), "pin": (0.0, 0.0, 0.0)}
    frames = tuple(
        SpaceFrame(name, Transform(place), None if name == "base" else "base")
        for name, place in poses.items()
    )
    return SpacePicture("base", frames, solids, chosen="ball")


def test_shapes_have_their_sizes(picture):
    solids = picture.solids
    firsts = [0, *(end for end, _ in solids.ends)]
    sizes = {
        name: np.ptp(solids.points[first:end], axis=0)
        for name, first, (end, _) in zip(solids.frames, firsts, solids.ends, strict=False)
        if end > first
    }

    np.testing.assert_allclose(sizes["base"], [2, 2, 1])
    np.testing.assert_allclose(sizes["ball"], [1, 1, 1], atol=0.03)
    np.testing.assert_allclose(sizes["pin"], [0.2, 0.2, 3], atol=0.01)


def cells(picture, name="orbit", columns=60, rows=24, **options):
    camera = OrbitCamera(name)
    view = camera.view(picture, corners_of(picture), columns, rows)
    lines = SpaceCanvas(columns, rows, **options).lines(picture, view)
    assert [sum(len(one.text) for one in line) for line in lines] == [columns] * rows
    return lines


def text(lines):
    return "\n".join("".join(one.text for one in line) for line in lines)


def inks(lines, wanted):
    return sum(
        len(one.text)
        for line in lines
        for one in line
        if one.style.color is not None and one.style.color.triplet.hex == wanted
    )


def test_axes_and_names_are_drawn_through_solids(picture):
    lines = cells(picture)
    paper = theme.paper(theme.DARK)

    for axis in (paper.x_axis, paper.y_axis, paper.z_axis):
        assert inks(lines, theme.hexadecimal(axis)) >= 2
    assert "base" in text(lines)
    assert "ball" in text(lines)


def test_the_line_from_a_name_does_not_hide_an_axis():
    robot = """<robot name="a"><link name="base_link"><visual><geometry>
    <cylinder radius="0.2" length="0.6"/></geometry></visual></link></robot>"""
    solids, _ = solids_of(parse_description(robot).links.values(), MeshFolders())
    frames = (SpaceFrame("base_link", Transform()),)
    lines = cells(SpacePicture("base_link", frames, solids), columns=54, rows=27)

    assert inks(lines, theme.hexadecimal(theme.paper(theme.DARK).x_axis)) >= 3


def test_frames_at_one_place_share_a_label(picture):
    shared = next(line for line in text(cells(picture)).splitlines() if "base" in line)

    assert "base, pin" in shared


def test_from_above_the_ball_covers_the_pin_and_from_the_side_it_does_not(picture):
    def green(name):
        return sum(
            len(one.text)
            for line in cells(picture, name)
            for one in line
            if one.style.color is not None
            and (rgb := one.style.color.triplet).green > 120
            and rgb.red == rgb.blue == 0
        )

    # The base is a square of 2 m from above, and half as large from the side.
    assert green("top") > 1.5 * green("side") > 20


def test_the_camera_turns_zooms_and_follows(picture):
    camera = OrbitCamera("front")
    corners = corners_of(picture)
    front = camera.view(picture, corners, 60, 24)
    # From the front, y points to the right and z up.
    np.testing.assert_allclose(front.axes, [[0, 1, 0], [0, 0, 1], [1, 0, 0]], atol=1e-12)
    camera.look_from("top")
    np.testing.assert_allclose(camera.view(picture, corners, 60, 24).axes, np.eye(3), atol=1e-12)
    camera.turn(0, 5)
    assert camera.view(picture, corners, 60, 24).axes[2, 2] == pytest.approx(1.0)
    scale = camera.view(picture, corners, 60, 24).scale
    camera.zoom(2)
    assert camera.view(picture, corners, 60, 24).scale == pytest.approx(scale / 1.25**2)
    camera.follows = "ball"
    np.testing.assert_allclose(camera.view(picture, corners, 60, 24).middle, [0, 0, 2])
    camera.fit()
    assert camera.view(picture, corners, 60, 24).scale == pytest.approx(scale)


@pytest.mark.parametrize("size", [(1, 1), (5, 3), (200, 60)])
def test_any_size_is_drawn(picture, size):
    cells(picture, columns=size[0], rows=size[1])


def test_no_frames_are_drawn_as_an_empty_ground():
    assert "grid " in text(cells(SpacePicture("base")))


@pytest.mark.parametrize(("tones", "ascii_only"), [("few", False), ("none", False), ("none", True)])
def test_shades_are_signs_where_colours_are_few(picture, tones, ascii_only):
    lines = cells(picture, tones=tones, ascii_only=ascii_only)

    ramp = "-=+*#%@" if ascii_only else "░▒▓█"
    assert len({one for one in text(lines) if one in ramp}) >= 2
    assert "▀" not in text(lines)
    if tones == "none":
        assert not any(one.style.color or one.style.bgcolor for line in lines for one in line)
    if ascii_only:
        assert text(lines).isascii()


def test_an_svg_has_the_solids_as_an_image_and_the_names_as_text(picture):
    svg = drawn_file(picture, "svg", title="arm & co").decode()
    image = base64.b64decode(re.search(r"base64,([^\"]+)", svg)[1])

    assert "<title>arm &amp; co</title>" in svg
    assert ">base, pin</text>" in svg
    assert image[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", image[16:24])
    start = image.index(b"IDAT")
    (length,) = struct.unpack(">I", image[start - 4 : start])
    rows = zlib.decompress(image[start + 4 : start + 4 + length])
    assert len(rows) == height * (1 + 4 * width)
    pixels = np.frombuffer(rows, np.uint8).reshape(height, -1)[:, 1:].reshape(height, width, 4)
    assert 0.03 < (pixels[..., 3] > 0).mean() < 0.9


def test_a_png_is_written_where_matplotlib_is(picture):
    pytest.importorskip("matplotlib")

    assert drawn_file(picture, "png")[:4] == b"\x89PNG"


def test_a_turned_link_turns_its_solid():
    solids, _ = solids_of(parse_description(ROBOT).links.values(), MeshFolders())
    pose = Transform((1.0, 0.0, 0.0), quaternion_from_rpy(0.0, np.pi / 2.0, 0.0))
    placed = solids.placed({"pin": pose})

    known = placed[np.isfinite(placed).all(1)]
    np.testing.assert_allclose(np.ptp(known, axis=0), [3, 0.2, 0.2], atol=0.01)


def spread(count):
    """Return frames around one root, far enough from each other for a name each."""
    frames = [SpaceFrame("root", Transform())]
    for number in range(count):
        angle = 2.0 * np.pi * number / count
        place = (np.cos(angle), np.sin(angle), 0.1 * (number % 2))
        frames.append(SpaceFrame(f"tip_{number:02}", Transform(place), "root"))
    return frames


def test_a_small_picture_names_the_chosen_frame_first_and_counts_the_unnamed():
    frames = tuple(spread(40))
    small = text(cells(SpacePicture("root", frames, chosen="tip_31"), columns=40, rows=15))
    large = text(cells(SpacePicture("root", frames, chosen="tip_31"), columns=160, rows=50))

    assert "tip_31" in small
    assert small.count("tip_") < 6 < large.count("tip_")
    assert re.search(r"grid \S+ m, \d\d of 41 frames unnamed", small)
    narrow = text(cells(SpacePicture("root", frames, chosen="tip_31"), columns=30, rows=20))
    assert re.search(r"grid \S+ m, \d\d of 41 unnamed", narrow)
    few = text(cells(SpacePicture("root", tuple(spread(3)), chosen="tip_01"), columns=60, rows=30))
    assert "unnamed" not in few


def test_names_do_not_cover_the_robot_where_there_is_room_beside_it(picture):
    lines = text(cells(picture, columns=80, rows=40)).splitlines()
    named = [line for line in lines if "ball" in line or "base" in line]

    assert len(named) == 2, lines
    # A name that covers the robot would have parts of the robot on both sides.
    assert not any(re.search(r"[▀▄].*[a-z]{4}.*[▀▄]", line) for line in named)


@pytest.mark.parametrize("options", [{"ascii_only": True}, {"tones": "none"}, {"tones": "few"}])
def test_a_ground_without_colours_has_dots_only_at_crossings(options):
    picture = SpacePicture("root", tuple(spread(3)))
    plain = text(cells(picture, columns=80, rows=40, **options))
    lines = text(cells(picture, columns=80, rows=40))

    def marks(drawn):
        return sum(sign in ".'_-|/\\" or "⠀" < sign <= "⣿" for sign in drawn)

    assert marks(plain) < 0.4 * marks(lines)


def test_names_in_a_small_picture_have_a_gap_to_the_robot(picture):
    lines = text(cells(picture, columns=34, rows=20)).splitlines()

    assert any("ball" in line for line in lines)
    assert not any(re.search(r"[▀▄][a-z]|[a-z][▀▄]", line) for line in lines)


def test_the_outline_of_a_solid_in_ascii_is_drawn_with_strokes():
    robot = """<robot name="post"><link name="post"><visual><geometry><box size="1 1 4"/></geometry>
    </visual></link></robot>"""
    solids, _ = solids_of(parse_description(robot).links.values(), MeshFolders())
    post = SpacePicture("post", (SpaceFrame("post", Transform()),), solids)
    lines = text(cells(post, "front", columns=40, rows=24, ascii_only=True)).splitlines()
    sides = [line for line in lines if re.search(r"\|\S*\|", line)]

    assert len(sides) >= 8
    assert len({(line.index("|"), line.rindex("|")) for line in sides}) <= 2


def test_a_thin_part_in_ascii_is_shaded_not_only_outlined():
    robot = """<robot name="rod"><link name="rod"><visual><geometry><box size="8 .5 .5"/></geometry>
    </visual></link></robot>"""
    solids, _ = solids_of(parse_description(robot).links.values(), MeshFolders())
    rod = SpacePicture("rod", (SpaceFrame("rod", Transform()),), solids)
    drawn = text(cells(rod, "side", columns=60, rows=24, ascii_only=True))

    assert sum(sign in ":=+*#%@" for sign in drawn) > 30
    assert not any(sign in "|/\\_" for sign in drawn)


@pytest.mark.parametrize("options", [{}, {"ascii_only": True}, {"tones": "none"}])
def test_the_axes_of_a_few_frames_have_letters_and_those_of_many_have_none(options):
    few, many = (
        text(cells(SpacePicture("root", tuple(spread(n))), columns=100, rows=40, **options))
        for n in (2, 20)
    )

    assert [few.count(letter) for letter in "xyz"] == [3, 3, 3]
    assert not set("xyz") & set(many)


def test_frames_above_each_other_are_labelled_with_their_heights():
    def drawn(x):
        frames = SpaceFrame("A", Transform()), SpaceFrame("B", Transform((x, 0, 3.0)), "A")
        return text(cells(SpacePicture("A", frames)))

    assert "B z 3 m" in drawn(0.0)
    assert "z 3 m" not in drawn(5.0)


def test_the_ground_below_high_frames_is_larger_than_two_steps_around_them():
    frames = SpaceFrame("A", Transform()), SpaceFrame("B", Transform((0, 0, 4.5)), "A")
    below = text(cells(SpacePicture("A", frames), columns=160, rows=50)[-12:])

    assert sum("\u2800" < sign <= "\u28ff" for sign in below) > 300


def test_axes_of_many_frames_are_shorter_so_that_they_overlap_less():
    def blue(count):
        lines = cells(SpacePicture("root", tuple(spread(count))), columns=160, rows=60)
        return inks(lines, theme.hexadecimal(theme.paper(theme.DARK).z_axis)) / count

    assert blue(80) < 0.7 * blue(8)


MESHES_ONLY = """<robot name="arm">
  <link name="base"><visual><geometry><mesh filename="package://gone/a.stl"/></geometry></visual>
    <collision><geometry><box size="0.4 0.4 0.1"/></geometry></collision></link>
  <link name="arm"><visual><geometry><mesh filename="package://gone/b.stl"/></geometry></visual></link>
  <link name="tip"/>
  <joint name="one" type="fixed"><parent link="base"/><child link="arm"/></joint>
  <joint name="two" type="fixed"><parent link="arm"/><child link="tip"/>
    <origin xyz="0 0 0.5"/></joint>
</robot>"""


def test_links_whose_meshes_are_missing_are_collision_shapes_or_rods_to_their_joints():
    robot = parse_description(MESHES_ONLY)

    solids, refused = solids_of(robot.links.values(), MeshFolders(), joints=robot.joints.values())

    bounds, first = {}, 0
    for frame, (end, _) in zip(solids.frames, solids.ends, strict=True):
        part = solids.points[first:end]
        bounds[frame] = (part.min(0).tolist(), part.max(0).tolist()) if len(part) else None
        first = end
    assert len(refused) == 2
    assert bounds["base"][1] == pytest.approx([0.2, 0.2, 0.05])
    # A thin rod from the origin to the tip, half a metre above it.
    assert bounds["arm"][1][2] == pytest.approx(0.5)
    assert max(bounds["arm"][1][:2]) < 0.1
    assert bounds["tip"] is None


LYING = """<robot name="r"><link name="root"/><link name="middle"><visual>
<origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry></visual></link>
<link name="tip"/><joint name="a" type="fixed"><parent link="root"/><child link="middle"/></joint>
<joint name="b" type="fixed"><parent link="middle"/><child link="tip"/></joint></robot>"""


@pytest.fixture
def lying():
    """Return the picture of a rod that lies on the ground along x."""
    solids, _ = solids_of(parse_description(LYING).links.values(), MeshFolders())
    frames = (
        SpaceFrame("root", Transform()),
        SpaceFrame("middle", Transform(), "root"),
        SpaceFrame("tip", Transform((1.0, 0.0, 0.0)), "middle"),
    )
    return SpacePicture("root", frames, solids)


def opened(picture, columns=34, rows=19):
    view = OrbitCamera().view(picture, corners_of(picture), columns, rows)
    return text(SpaceCanvas(columns, rows).lines(picture, view)).splitlines()


def test_a_lying_robot_is_first_shown_from_where_it_fills_the_picture(lying):
    rows = [line for line in opened(lying) if "▀" in line or "▄" in line]

    assert len(rows) >= 11


def test_of_a_robot_the_root_and_the_tips_are_named_first(lying):
    # The middle link is at the root; its own name would be in the same label.
    moved = replace(lying.frames[1], pose=Transform((0.5, 0.0, 0.0)))
    picture = replace(lying, frames=(lying.frames[0], moved, lying.frames[2]))

    few = "".join(opened(picture))
    assert "root" in few
    assert "tip" in few
    assert "middle" not in few
    assert "middle" in "".join(opened(replace(picture, names_all=True)))
    assert "middle" in "".join(opened(replace(picture, chosen="middle")))


@pytest.mark.parametrize(("height", "name"), [(0.0, "top"), (0.5, "orbit")])
def test_a_flat_world_is_first_shown_from_above(height, name):
    frames = tuple(
        SpaceFrame(f"frame_{x}", Transform((x, 2.0 * x, height * x)), "map" if x else None)
        for x in range(3)
    )
    camera, picture = OrbitCamera(), SpacePicture("frame_0", frames)
    camera.view(picture, corners_of(picture), 60, 20)

    assert camera.name == name


def test_the_ground_has_at_most_ten_steps_to_a_side():
    frames = (SpaceFrame("a", Transform()), SpaceFrame("b", Transform((9.0, 7.0, 0.0)), "a"))
    rows = opened(SpacePicture("a", frames), 120, 40)

    # A frame 9 m away: with a grid of 2 m the ground has 4.5 steps, and 2 around them.
    assert "grid 2 m" in rows[-1]
