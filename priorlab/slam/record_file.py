"""Records of arrays in a file that only grows: each has a mark, its length and a checksum, so that a torn end is known as one."""

from __future__ import annotations

import io
import os
import zlib
from typing import Any, BinaryIO

import numpy as np

MARK = b"priorlab record\n"


def pack_record(arrays: dict[str, Any]) -> bytes:
    """A record: mark, length, checksum, arrays."""
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    content = stream.getvalue()
    return MARK + len(content).to_bytes(8, "little") + zlib.crc32(content).to_bytes(4, "little") + content


def append_record(file: BinaryIO, record: bytes) -> None:
    """Add a record and wait until the disk has it."""
    file.write(record)
    file.flush()
    os.fsync(file.fileno())


def whole_records(content: bytes) -> tuple[list[bytes], int]:
    """The whole records, at least two, and where they end; what follows may only be one that was being added."""
    records, place = [], 0
    while place < len(content):
        start = place + len(MARK) + 12
        length, checksum = (int.from_bytes(content[a:b], "little") for a, b in ((start - 12, start - 4), (start - 4, start)))
        record = content[start : start + length]
        is_marked = content[place : place + len(MARK)] == MARK
        if not is_marked or start > len(content) or len(record) < length or zlib.crc32(record) != checksum:
            break
        records.append(record)
        place = start + length
    if len(records) < 2:
        raise ValueError("it does not begin with whole records")
    if MARK in content[place + 1 :]:
        raise ValueError(f"record {len(records)} is broken, and more follow")
    return records, place
