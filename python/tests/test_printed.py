"""The comparison of printed texts rejects what it must."""

from __future__ import annotations

from printed import difference


def test_equal_texts_agree() -> None:
    assert difference("Em 343.2 ± 1.9 lx", "Em 343.2  ± 1.9 lx", exact=True) == ""


def test_last_digits_count_on_the_same_processor() -> None:
    assert difference("343.2 ± 1.9", "343.3 ± 1.9", exact=True)
    assert difference("343.2 ± 1.9", "343.3 ± 1.9", exact=False) == ""


def test_more_than_five_units_of_the_last_digit_are_refused() -> None:
    assert difference("343.2", "343.7", exact=False) == ""
    assert difference("343.2", "343.8", exact=False)
    assert difference("1.23e-06", "1.29e-06", exact=False)


def test_counts_and_words_must_be_equal() -> None:
    assert difference("48 points", "49 points", exact=False)
    assert difference("48 points", "48 tiles", exact=False)
    assert difference("48", "48 49", exact=False)


def test_figures_may_be_rounded_the_other_way() -> None:
    assert difference("349 ± 2 lx", "350 ± 2 lx", exact=False) == ""
    assert difference("349 ± 2 lx", "349 ± 3 lx", exact=False) == ""
    assert difference("349 ± 2 lx", "351 ± 2 lx", exact=False)
    assert difference("349 ± 2 lx", "350 ± 2 lx", exact=True)
