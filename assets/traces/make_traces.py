#!/usr/bin/env python3
"""Writes the head and gaze traces beside this file.

studio.*: three seconds in the studio's first camera. The gaze rests on things, not on places of the picture: while the
head moves, each place looked at is where its thing is seen from there, as an eye keeps it. Run again after the scene
has changed, with the places below measured anew (dioptre render --gaze X,Y --log F says the dioptres under a gaze).

everyday.py writes the others, ten seconds for any scene.
"""
import everyday
import math
import pathlib
import random

FOLDER = pathlib.Path(__file__).parent
SECONDS = 3.0
TAN_HALF_Y = math.tan(math.radians(47.0) / 2)  # of the camera
TAN_HALF_X = TAN_HALF_Y * 4 / 3

# Place in the picture from the camera itself, dioptres there.
LEAF = (0.894, 0.473, 3.44)
CITY = (0.617, 0.375, 0.0006)  # out of the window
GLOBE = (0.400, 0.600, 0.91)
# Seconds from which each is looked at; a saccade of that many seconds leads there.
FIXATIONS = [(0.0, 0.0, LEAF), (0.7, 0.06, CITY), (1.9, 0.05, GLOBE)]
BLINK = (1.4, 1.55)
FIXATION_NOISE = 0.001  # of the picture's side


def head(t):
    """Position (m) and yaw, pitch (radians): a seated sway that begins and ends at the camera."""
    p = 2 * math.pi * t / SECONDS
    position = (0.025 * math.sin(p), 0.006 * math.sin(2 * p), -0.0075 * (1 - math.cos(p)))
    return position, math.radians(1.5) * math.sin(p), math.radians(0.8) * math.sin(2 * p)


def quaternion(yaw, pitch):
    """Yaw about y after pitch about x, as x, y, z, w."""
    cy, sy, cx, sx = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    return (cy * sx, sy * cx, -sy * sx, cy * cx)


def seen(thing, t):
    """Where a thing is in the picture from the head at time t."""
    u, v, dioptres = thing
    position, yaw, pitch = head(t)
    depth = 1 / dioptres
    x = (2 * u - 1) * TAN_HALF_X * depth - position[0]
    y = (1 - 2 * v) * TAN_HALF_Y * depth - position[1]
    z = -depth - position[2]
    x, z = x * math.cos(yaw) - z * math.sin(yaw), x * math.sin(yaw) + z * math.cos(yaw)
    y, z = y * math.cos(pitch) + z * math.sin(pitch), -y * math.sin(pitch) + z * math.cos(pitch)
    return (0.5 + 0.5 * x / -z / TAN_HALF_X, 0.5 - 0.5 * y / -z / TAN_HALF_Y)


def gaze(t):
    place = seen(FIXATIONS[0][2], t)
    for start, duration, thing in FIXATIONS[1:]:
        if t >= start:
            s = min((t - start) / duration, 1.0)
            s = s * s * (3 - 2 * s)
            place = tuple(a + (b - a) * s for a, b in zip(place, seen(thing, t)))
    return place


def number(value):
    return ("%.6f" % value).replace("-0.000000", "0.000000")


def main():
    rows = ["# A seated viewer's sway relative to the camera: 2.5 cm sideways, 1.5 cm forward, 1.5 degrees of turn, 0.8 of nod.",
            "t_s,x,y,z,qx,qy,qz,qw"]
    for i in range(31):
        position, yaw, pitch = head(i / 10)
        rows.append("%.1f," % (i / 10) + ",".join(number(v) for v in position + quaternion(yaw, pitch)))
    (FOLDER / "studio.head.csv").write_text("\n".join(rows) + "\n")

    noise = random.Random(4)
    rows = ["# A gaze over the studio, made with studio.head.csv: a leaf near by, the city far out of the window with one",
            "# blink, the globe between them.", "t_s,x,y,valid"]
    for i in range(181):
        t = i / 60
        x, y = (p + noise.gauss(0, FIXATION_NOISE) for p in gaze(t))
        open_eye = not BLINK[0] <= t < BLINK[1]
        rows.append("%.4f," % t + ("%.4f,%.4f,1" % (x, y) if open_eye else "nan,nan,0"))
    (FOLDER / "studio.gaze.csv").write_text("\n".join(rows) + "\n")

    everyday.write(FOLDER)


if __name__ == "__main__":
    main()
