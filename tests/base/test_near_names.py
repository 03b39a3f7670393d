"""Tests of proposals for unknown names."""

from tftool.base.plain_text import LONGEST, did_you_mean, near_names


def test_the_likest_names_come_first_whatever_their_case():
    known = ["base_link", "base_footprint", "Camera_Link", "odom"]

    assert near_names("base_lnk", known, 3)[0] == "base_link"
    assert near_names("camera_link", known) == ["Camera_Link"]
    assert near_names("BASE_LINK", known) == ["base_link"]
    assert near_names("xyz", known, 3) == []


def test_how_like_a_name_has_to_be_can_be_said():
    assert near_names("Publisher", ["Puplisher"], alike=0.8) == ["Puplisher"]
    assert near_names("Node", ["Note"], alike=0.9) == []


def test_a_long_word_is_compared_by_its_beginning():
    assert near_names("m" * 10**6, ["m" * LONGEST]) == ["m" * LONGEST]


def test_the_end_of_a_sentence_names_what_was_meant_if_anything():
    assert did_you_mean("turtle", {"turtle1": 1}) == "; did you mean 'turtle1'?"
    assert did_you_mean("turtle", ()) == ""
