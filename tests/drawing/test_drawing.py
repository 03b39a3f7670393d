"""Tests of pictures of the tree: exact small ones, escapes in every format, thousands of frames."""

import base64
import hashlib
import re
import struct
import zlib
from xml.etree import ElementTree

import pytest

from tftool.base.stamps import seconds
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing.tree_picture import draw
from tftool.geometry.rigid import Transform

HOSTILE = [
    '"; evil [label="x"]; "',
    "back\\slash\\",
    "<script>alert(1)</script>",
    "a&lt;b",
    "]]> -->",
    "line\nbreak\x1b[31m",
    "right\u202eto left",
    "שלום",
    "🐢",
    "f" * 500,
    "end",
    "(paren) Tj",
    "1. list",
    "`tick` **bold**",
    "\ud800",
]


def link(frame, parent, *, static=False, authority="default_authority", **facts):
    given = {"rate": 10000.0, "oldest": 0, "newest": 0, **facts}
    return FrameInfo(
        frame=frame,
        parent=parent,
        is_static=static,
        authority=authority,
        samples=1,
        buffer_length=given["newest"] - given["oldest"],
        age=0,
        transform=Transform(),
        root=None,
        root_from_frame=None,
        **given,
    )


def root(frame):
    return link(frame, None, authority=None)


def snapshot(*frames, now=seconds(12.5), at=0):
    return Snapshot(now, at, tuple(frames))


def base(**more):
    return link("base", "world", rate=1.5, oldest=seconds(1), newest=seconds(3), **more)


def hostile():
    return snapshot(root("world"), *(link(name, "world", authority=name) for name in HOSTILE))


def many(count, fan=3):
    return snapshot(
        root("f0"), *(link(f"f{index}", f"f{(index - 1) // fan}") for index in range(1, count))
    )


# dot


def test_dot_is_what_view_frames_writes():
    # spec 7.6: numbers are Python floats, Buffer length is before Most recent, \n is at the end
    drawn = draw(snapshot(root("world"), base(), link("arm", "base")), "dot").content

    assert drawn == (
        "digraph G {\n"
        '"world" -> "base"[label=" Broadcaster: default_authority\\nAverage rate: 1.5\\n'
        'Buffer length: 2.0\\nMost recent transform: 3.0\\nOldest transform: 1.0\\n"];\n'
        '"base" -> "arm"[label=" Broadcaster: default_authority\\nAverage rate: 10000.0\\n'
        'Buffer length: 0.0\\nMost recent transform: 0.0\\nOldest transform: 0.0\\n"];\n'
        "edge [style=invis];\n"
        ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";\n'
        '"Recorded at time: 12.5"[ shape=plaintext ] ;\n'
        '}->"world";\n'
        "}"
    )


def test_dot_of_nothing_is_what_view_frames_writes():
    assert draw(snapshot(), "dot").content == 'digraph G { "No tf data received" }'
    assert draw(snapshot(root("lonely")), "dot").content == 'digraph G { "No tf data received" }'


def test_dot_dashes_static_links():
    drawn = draw(snapshot(root("A"), link("B", "A", static=True)), "dot").content

    assert r'Oldest transform: 0.0\n", style=dashed];' in drawn


def test_dot_ties_every_root_to_the_legend_and_a_loop_to_none():
    two = draw(snapshot(root("A"), link("B", "A"), root("C"), link("D", "C")), "dot").content
    loop = draw(snapshot(link("A", "B"), link("B", "A")), "dot").content

    assert '}->{"A" "C"};\n}' in two
    assert loop.endswith(";\n}\n}")


DOT_TOKENS = re.compile(r'"(?:[^"\\]|\\.)*"|[A-Za-z_]+|->|[{}\[\];=,]|(\s+)|(.)', re.DOTALL)


def dot_edges(text):
    """Read dot by its lexical rules; return the quoted ends of the edges."""
    tokens = []
    for found in DOT_TOKENS.finditer(text):
        assert found[2] is None, f"{found[2]!r} is no token of dot"
        if not found[1]:
            tokens.append(found[0])
    assert tokens.count("{") == tokens.count("}")
    return [
        (tokens[place - 1], tokens[place + 1])
        for place, token in enumerate(tokens)
        if token == "->" and tokens[place + 2] == "["
    ]


def test_no_name_escapes_from_dot():
    drawn = draw(hostile(), "dot").content

    edges = dot_edges(drawn)
    assert len(edges) == len(HOSTILE)
    assert {parent for parent, _ in edges} == {'"world"'}
    assert "evil [label" in drawn.replace('\\"', '"')  # the text is part of a name
    assert "\x1b" not in drawn
    assert r'"a&lt;b"[label="a&amp;lt;b"];' in drawn


def test_dot_holds_all_of_five_thousand_frames():
    drawn = draw(many(5000), "dot")

    assert len(dot_edges(drawn.content)) == 4999
    assert (drawn.left_out, drawn.note) == (0, "")


# mermaid


def test_mermaid_draws_static_links_dashed_and_roots_round():
    drawn = draw(snapshot(root("world"), base(), link("arm", "base", static=True)), "mermaid")

    assert drawn.content == (
        "flowchart TD\n"
        '  legend["Recorded at time: 12.5"]:::legend\n'
        '  f0(["world"])\n'
        '  f1["base"]\n'
        '  f2["arm"]\n'
        '  f0 -->|"Broadcaster: default_authority<br>Average rate: 1.5 Hz<br>'
        'Buffer length: 2.0 s<br>Most recent transform: 3.0 s<br>Oldest transform: 1.0 s"| f1\n'
        '  f1 -.->|"Broadcaster: default_authority<br>Average rate: 10000.0 Hz<br>'
        'Buffer length: 0.0 s<br>Most recent transform: 0.0 s<br>Oldest transform: 0.0 s"| f2\n'
        "  legend ~~~ f0\n"
        "  classDef legend fill:none,stroke:none\n"
    )


def test_no_name_escapes_from_mermaid():
    drawn = draw(hostile(), "mermaid").content

    labels = re.findall(r'"([^"]*)"', drawn)
    assert len(labels) == 1 + 1 + 2 * len(HOSTILE)
    for label in labels:
        assert not re.search(r"[<>`*\\]|&(?!amp)", label.replace("<br>", ""))
    assert "1#46; list" in drawn
    assert "#60;script#62;alert#40;1#41;#60;/script#62;" in drawn


def test_a_name_is_no_icon_in_mermaid():
    drawn = draw(snapshot(root("fa:fa-car"), link("b", "fa:fa-car")), "mermaid").content

    assert "fa:fa-" not in drawn


def test_mermaid_says_what_it_leaves_out():
    shorter = draw(many(300), "mermaid")
    cut = draw(many(5000), "mermaid")
    long_names = draw(
        snapshot(root("r"), *(link(f"{'x#' * 200}{index}", "r") for index in range(400))),
        "mermaid",
    )

    assert shorter.left_out == 0
    assert "only their rate" in shorter.note
    assert (cut.left_out, cut.content.count("-->|")) == (4550, 449)
    assert "450 of 5000 frames shown, 4550 left out" in cut.note
    assert "450 of 5000 frames shown" in cut.content
    assert len(long_names.content) <= 50_000
    assert long_names.left_out > 0


# svg

SVG = "{http://www.w3.org/2000/svg}"


def svg(frames):
    return ElementTree.fromstring(draw(frames, "svg").content)


def words(tree):
    return [element.text for element in tree.iter(f"{SVG}text")]


def test_svg_tells_the_five_facts_of_every_link_and_when_it_was_recorded():
    told = words(svg(snapshot(root("world"), base())))

    assert told == [
        "world",
        "base",
        "Broadcaster: default_authority",
        "Average rate: 1.5 Hz",
        "Buffer length: 2.0 s",
        "Most recent transform: 3.0 s",
        "Oldest transform: 1.0 s",
        "Recorded at time: 12.5",
        "dynamic",
        "static",
        "2 frames in 1 tree",
    ]


def test_svg_tells_of_a_static_link_who_broadcasts_it_and_no_rate_nor_age():
    told = words(svg(snapshot(root("A"), link("B", "A", static=True))))

    assert told[:4] == ["A", "B", "static", "Broadcaster: default_authority"]
    assert not any(" Hz" in line or " s" in line for line in told[4:])


def test_svg_keeps_every_line_of_a_card_to_its_width_whatever_font_is_there():
    tree = svg(snapshot(root("world"), base(), link("arm_of_the_robot", "base", static=True)))

    kept = [text.text for text in tree.iter(f"{SVG}text") if text.get("textLength")]
    assert {"world", "base", "arm_of_the_robot", "static"} <= set(kept)
    facts = [one for one in words(tree) if one.startswith(("Average rate", "Most recent"))]
    assert len(facts) == 2
    assert set(facts) <= set(kept)


@pytest.mark.parametrize("many", [2, 30])
def test_svg_draws_lower_cards_where_all_are_static(many):
    def height(**facts):
        links = [link(f"f{number}", "A", **facts) for number in range(many)]
        return float(svg(snapshot(root("A"), *links)).get("height"))

    assert height(static=True) < height()


def test_svg_draws_a_parent_over_its_child_and_joins_them():
    tree = svg(snapshot(root("world"), base()))

    upper, lower = tree.iter(f"{SVG}rect")
    line = next(tree.iter(f"{SVG}path"))
    middle = float(upper.get("x")) + float(upper.get("width")) / 2
    bottom = float(upper.get("y")) + float(upper.get("height"))
    assert middle == pytest.approx(float(lower.get("x")) + float(lower.get("width")) / 2, abs=0.1)
    assert bottom < float(lower.get("y"))
    assert line.get("d").startswith(f"M{middle:g} {bottom:g}")
    assert line.get("d").endswith(f"{middle:g} {lower.get('y')}")


def test_svg_draws_static_links_and_frames_differently():
    tree = svg(snapshot(root("A"), link("B", "A", static=True), link("C", "A")))

    kinds = [element.get("class") for element in tree.iter(f"{SVG}rect")]
    styles = [element.get("class") for element in tree.iter(f"{SVG}path")]
    assert kinds == ["root", "static", "dynamic"]
    assert styles == ["still", None, None, "still"]  # two edges, and the legend's two


def test_svg_shows_the_moment_looked_at_beside_the_moment_recorded():
    assert "shown: 7.25" in words(svg(snapshot(root("w"), base(), at=seconds(7.25))))


def test_every_hostile_name_is_text_in_well_formed_svg():
    tree = svg(hostile())

    names = {element.tag.removeprefix(SVG) for element in tree.iter()}
    assert names == {"svg", "title", "style", "path", "rect", "text"}
    titles = {element.text for element in tree.iter(f"{SVG}title")}
    assert "<script>alert(1)</script>" in titles
    assert "line␊break␛[31m" in titles
    assert "right⟨U+202E⟩to left" in titles
    assert "⟨U+D800⟩" in titles
    assert "f" * 500 in titles
    assert max(map(len, words(tree))) < 100


def test_names_that_look_alike_once_visible_stay_apart():
    tree = svg(snapshot(root("a\x1b"), link("a␛", "a\x1b")))

    assert {"a␛", "a␛ (2)"} <= set(words(tree))


def test_svg_of_nothing_says_so():
    assert "No tf data received" in words(svg(snapshot()))


def boxes(tree):
    return [
        tuple(float(element.get(side)) for side in ("x", "y", "width", "height"))
        for element in tree.iter(f"{SVG}rect")
        if element.get("class") != "group"
    ]


@pytest.mark.parametrize("fan", [1, 2, 3, 7, 299])
def test_three_hundred_frames_do_not_cover_one_another(fan):
    tree = svg(many(300, fan=fan))

    placed = boxes(tree)
    assert len(placed) == 300
    wide, high = float(tree.get("width")), float(tree.get("height"))
    for index, (x, y, width, height) in enumerate(placed):
        assert x >= 0
        assert y >= 0
        assert x + width <= wide
        assert y + height <= high
        for x2, y2, width2, height2 in placed[:index]:
            apart = x2 >= x + width or x >= x2 + width2 or y2 >= y + height or y >= y2 + height2
            assert apart


def test_many_leaves_of_one_parent_are_a_group_of_about_a_screens_shape():
    tree = svg(many(300, fan=299))

    assert len([e for e in tree.iter(f"{SVG}rect") if e.get("class") == "group"]) == 1
    assert 0.8 < float(tree.get("width")) / float(tree.get("height")) < 2.5


def test_several_trees_stand_side_by_side():
    tree = svg(snapshot(root("A"), link("B", "A"), root("C"), link("D", "C")))

    placed = boxes(tree)
    assert max(x + width for x, _, width, _ in placed[:1]) < placed[1][0]
    assert "4 frames in 2 trees" in words(tree)


def test_a_picture_of_five_thousand_frames_says_what_it_leaves_out():
    drawn = draw(many(5000), "svg")

    assert drawn.left_out == 4000
    assert "leaves out 4000" in drawn.note
    told = words(ElementTree.fromstring(drawn.content))
    assert "1,000 frames shown, 4,000 left out: those farthest from their root" in told
    hidden = [int(word[2:]) for word in told if re.fullmatch(r"\+ \d+", word)]
    assert sum(hidden) == 4000


def test_a_loop_is_drawn_and_said():
    told = words(svg(snapshot(root("w"), link("x", "w"), link("A", "B"), link("B", "A"))))

    assert {"A", "B", "w", "x"} <= set(told)
    assert any(word.startswith("A loop: the parent of A is B") for word in told)


# pdf


def pdf_text(data):
    """Read a PDF with its table of objects; return the drawing commands of its page."""
    assert data.startswith(b"%PDF-1.")
    start = int(re.search(rb"startxref\n(\d+)\n%%EOF\n$", data)[1])
    head, table = re.match(rb"xref\n0 (\d+)\n((?:\d{10} \d{5} [nf] \n)+)", data[start:]).groups()
    entries = table.splitlines()
    assert len(entries) == int(head)
    for number, entry in enumerate(entries[1:], start=1):
        assert data[int(entry[:10]) :].startswith(b"%d 0 obj\n" % number)
    length, begin = re.search(rb"/Length (\d+) /Filter /FlateDecode >>\nstream\n()", data).groups()
    del begin
    stream = data.index(b"stream\n") + 7
    assert data[stream + int(length) :].startswith(b"\nendstream")
    return zlib.decompress(data[stream : stream + int(length)])


def test_pdf_holds_the_same_words_as_svg():
    frames = snapshot(root("world"), base(), link("arm", "base", static=True))
    content = pdf_text(draw(frames, "pdf").content)

    told = re.findall(rb"\(((?:[^()\\]|\\.)*)\) Tj", content)
    assert [word.decode("cp1252") for word in told] == words(svg(frames))


def test_pdf_writes_letters_helvetica_lacks_as_numbers():
    content = pdf_text(draw(snapshot(root("🐢"), link("Käfer", "🐢")), "pdf").content)

    assert b"(<U+1F422>) Tj" in content
    assert "(Käfer) Tj".encode("cp1252") in content


def test_no_name_escapes_from_a_pdf_string():
    content = pdf_text(draw(hostile(), "pdf").content)

    outside = re.sub(rb"\((?:[^()\\]|\\.)*\)", b"", content)
    assert b"(" not in outside
    assert b")" not in outside
    assert rb"(\(paren\) Tj) Tj" in content


def test_a_pdf_page_never_grows_beyond_what_readers_take():
    data = draw(many(1000, fan=1), "pdf").content

    box = re.search(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", data)
    assert max(float(box[1]), float(box[2])) <= 14_400


# Frames that are no longer sent, letters that a font lacks, and the page


STALE = {"base": ("edge-stopped",)}


def old():
    return base()._replace(age=seconds(9.5))


def test_a_card_of_a_frame_that_is_sent_no_more_is_marked_and_says_how_old_it_is():
    frames = snapshot(root("world"), old())

    marked, plain = draw(frames, "svg", STALE).content, draw(frames, "svg").content

    assert '<rect class="stale"' in marked
    assert ">Most recent transform: 3.0 s, 9.5 s old</text>" in marked
    assert '<rect class="stale"' not in plain
    # An amber border, 0.851 0.451 0.102
    assert "0.85 0.45 0.10 RG" in unpacked(draw(frames, "pdf", STALE).content)
    assert "0.85 0.45 0.10 RG" not in unpacked(draw(frames, "pdf").content)


def unpacked(file):
    return zlib.decompress(re.search(rb"stream\n(.*?)\nendstream", file, re.DOTALL)[1]).decode(
        "latin-1"
    )


def test_a_pdf_says_which_letters_it_cannot_show():
    frames = snapshot(root("world"), link("車輪", "world", static=True))

    note = draw(frames, "pdf").note

    assert "no letter for 車 輪:" in note
    assert "<U+8ECA>" in note
    assert draw(frames, "svg").note == ""
    assert draw(snapshot(root("world"), base()), "pdf").note == ""


def test_of_many_letters_that_are_missing_some_are_named_and_the_rest_counted():
    frames = snapshot(root("".join(chr(0x4E00 + n) for n in range(15))))

    assert "and 3 more: each" in draw(frames, "pdf").note


def test_the_page_is_one_file_with_the_picture_and_every_fact():
    frames = snapshot(root("world"), old(), link("sensor", "base", static=True, authority="tf"))

    page = draw(frames, "html", STALE).content

    assert page.startswith("<!doctype html>")
    assert not re.search(r"<script [^>]|https?://(?!www\.w3\.org/2000/svg)|@import|url\(", page)
    assert page.count("<svg ") == 1
    rows = re.findall(r"<tr.*?</tr>", page)
    cells = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows]
    assert cells == [
        ["frame", "parent", "link", "broadcaster", "rate", "buffer length", "oldest", "newest",
         "age", "wrong"],
        ["world", *[""] * 9],
        ["base", "world", "dynamic", "default_authority", "-", "2.000 s", "1.000000", "3.000000",
         "9.500 s", "edge-stopped"],
        ["sensor", "base", "static", "tf", *["-"] * 5, ""],
    ]  # fmt: skip


def test_names_are_nothing_but_names_in_the_page():
    page = draw(hostile(), "html").content

    # The page has one script, which its security policy allows.
    (script,) = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    allowed = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"script-src 'sha256-{allowed}'" in page
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in page
    assert "\x1b" not in page
    assert "\u202e" not in page


def test_a_png_is_as_wide_as_the_picture():
    pytest.importorskip("matplotlib")
    frames = snapshot(root("world"), old(), link("a$b$", "base", static=True, authority="tf"))

    image = draw(frames, "png").content
    svg = draw(frames, "svg").content

    assert image[:8] == b"\x89PNG\r\n\x1a\n"
    wide, high = struct.unpack(">II", image[16:24])
    asked = [float(one) for one in re.search(r'width="(\S+)" height="(\S+)"', svg).groups()]
    assert (wide, high) == pytest.approx([2 * one for one in asked], abs=2)


def test_the_page_of_nothing_says_so():
    assert "No tf data received" in draw(snapshot(), "html").content
