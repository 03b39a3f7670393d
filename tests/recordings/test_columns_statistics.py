"""Statistics of columns equal numpy's."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tftool.recordings.contract import percentile

NUMBERS = st.one_of(
    st.lists(st.integers(-(10**12), 10**12), min_size=1),
    st.lists(st.floats(-1e6, 1e6), min_size=1),
)


@given(NUMBERS, st.sampled_from([0, 5, 50, 75, 90, 95, 100]))
def test_a_percentile_equals_numpys(numbers, percent):
    values = np.array(numbers)

    assert np.isclose(percentile(values, percent), np.percentile(values, percent), atol=1e-9)
