# SPDX-License-Identifier: Apache-2.0
"""Random numbers that no version of Python changes."""


def random_numbers(seed):
    """A function of (low, high): a linear congruential generator with Numerical Recipes' constants."""
    state = seed

    def random(low, high):
        nonlocal state
        state = (state * 1664525 + 1013904223) % 2**32
        return low + (high - low) * (state >> 8) / 2**24
    return random
