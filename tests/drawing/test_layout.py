"""Tests that the layout of a tree obeys its rules, for any trees."""

from hypothesis import given
from hypothesis import strategies as st

from tftool.drawing.tree_layout import Item, Spot, tidy

GAP = 10.0
TREE_GAP = 40.0


def test_a_parent_stands_over_the_middle_of_its_children():
    items = [Item(40, (1, 2)), Item(20), Item(60)]

    # Width 20 + gap 10 + width 60. The children's centres are 10 and 60, and the parent's is
    # between them.
    assert tidy(items, [0], gap=GAP, tree_gap=TREE_GAP) == [
        Spot(35, 0),
        Spot(10, 1),
        Spot(60, 1),
    ]


def test_trees_stand_side_by_side_and_clear_of_each_other():
    items = [Item(20), Item(30)]

    assert tidy(items, [0, 1], gap=GAP, tree_gap=TREE_GAP) == [Spot(10, 0), Spot(75, 0)]


def test_small_subtrees_between_large_ones_are_spread_evenly():
    # The outer children have wide subtrees two levels down; the leaf between them has free space.
    items = [
        Item(10, (1, 2, 3)),
        Item(10, (4, 5, 6)),
        Item(10),
        Item(10, (7, 8, 9)),
        *[Item(10)] * 6,
    ]

    places = tidy(items, [0], gap=GAP, tree_gap=TREE_GAP)

    left, leaf, right = (places[index].middle for index in (1, 2, 3))
    assert leaf - left == right - leaf == 30


def test_nothing_is_placed_when_there_is_nothing():
    assert tidy([], [], gap=GAP, tree_gap=TREE_GAP) == []


def test_an_item_that_fills_levels_keeps_others_off_all_of_them():
    # Item 1 fills levels 1 and 2; item 3 is on level 2 and would be placed below it.
    items = [Item(10, (1, 2)), Item(10, levels=2), Item(10, (3,)), Item(50)]

    places = tidy(items, [0], gap=GAP, tree_gap=TREE_GAP)

    assert places[3].middle - 25 - (places[1].middle + 5) >= GAP - 1e-9


def test_a_chain_of_thousands_does_not_exhaust_the_stack():
    deep = 20_000
    items = [Item(10, (index + 1,)) for index in range(deep - 1)] + [Item(10)]

    places = tidy(items, [0], gap=GAP, tree_gap=TREE_GAP)

    assert places[-1] == Spot(5, deep - 1)


@given(st.data())
def test_neighbours_keep_their_distance_and_parents_their_middle(data):
    count = data.draw(st.integers(1, 30))
    parents = [data.draw(st.integers(-1, index - 1)) for index in range(count)]
    children = [
        tuple(index for index in range(count) if parents[index] == of) for of in range(count)
    ]
    breadths = [data.draw(st.floats(1, 100)) for _ in range(count)]
    items = [Item(*pair) for pair in zip(breadths, children, strict=True)]
    roots = [index for index in range(count) if parents[index] == -1]

    places = tidy(items, roots, gap=GAP, tree_gap=TREE_GAP)

    for one in range(count):
        for other in range(one):
            if places[one].level == places[other].level:
                apart = abs(places[one].middle - places[other].middle)
                assert apart >= (breadths[one] + breadths[other]) / 2 + GAP - 1e-6
        if children[one]:
            ends = places[children[one][0]].middle, places[children[one][-1]].middle
            assert abs(places[one].middle - sum(ends) / 2) < 1e-6
    assert abs(min(p.middle - b / 2 for p, b in zip(places, breadths, strict=True))) < 1e-6
