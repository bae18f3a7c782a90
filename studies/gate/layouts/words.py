"""Formats numbers for the tables."""

import os
import re
from pathlib import Path


def percent(value, digits=2):
    return f"{100 * value:.{digits}f}%"


def quantile(values, p):
    ordered = sorted(values)
    place = p * (len(ordered) - 1)
    low = int(place)
    return ordered[low] + (place - low) * (ordered[min(low + 1, len(ordered) - 1)] - ordered[low])


def duration(seconds):
    for unit, size in (("ms", 1e-3), ("us", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def load():
    return os.getloadavg()[0]


def host(loads):
    """The machine, and how busy it was."""
    processor = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    name = processor.group(1) if processor else "unknown processor"
    return (f"{name}, {os.cpu_count()} cores, load {min(loads):.1f} to {max(loads):.1f} "
            f"(median {quantile(loads, 0.5):.1f})")
