"""A film for the browser's fake camera: something red moves from place to place, on grey."""

from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np

WIDTH, HEIGHT, RATE_HZ = 320, 240, 20
EMPTY_S, STILL_S, STROKE_S, AFTER_S = 2.0, 0.4, 1.2, 4.0
RED, GREY, RADIUS = (210, 30, 30), (128, 128, 128), 14


def film(path: Path, places: list[tuple[float, float]]) -> Path:
    """Write nothing for a while, a red ball going through places of the view, nothing again.

    The camera faces the person, and the page mirrors what it sees.
    """
    frames = [_frame(None)] * round(EMPTY_S * RATE_HZ)
    frames += [_frame(places[0])] * round(STILL_S * RATE_HZ)
    for start, end in pairwise(places):
        for time in np.linspace(0, 1, round(STROKE_S * RATE_HZ)):
            share = time**3 * (10 - 15 * time + 6 * time**2)
            frames.append(_frame(tuple(np.add(start, share * np.subtract(end, start)))))
    frames += [_frame(places[-1])] * round(STILL_S * RATE_HZ)
    frames += [_frame(None)] * round(AFTER_S * RATE_HZ)
    head = f"YUV4MPEG2 W{WIDTH} H{HEIGHT} F{RATE_HZ}:1 Ip A1:1 C420jpeg\n".encode()
    path.write_bytes(head + b"".join(b"FRAME\n" + frame for frame in frames))
    return path


def _frame(place: tuple[float, ...] | None) -> bytes:
    picture = np.full((HEIGHT, WIDTH, 3), GREY, np.uint8)
    if place is not None:
        middle = round((1 - place[0]) * WIDTH), round(place[1] * HEIGHT)
        cv2.circle(picture, middle, RADIUS, RED, -1)
    return cv2.cvtColor(picture, cv2.COLOR_RGB2YUV_I420).tobytes()
