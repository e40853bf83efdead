"""Ten seconds of what heads and eyes do, for any scene: seated, walk, reading, sweep, dropouts.

Head poses are relative to where the view begins and begin there themselves. Gazes rest on directions of the world, not
on places of the picture: while the head turns, the eyes turn back.
"""
import math
import random

SECONDS = 10.0
HEAD_HZ, GAZE_HZ = 60, 90
TAN_HALF_X, TAN_HALF_Y = 0.58, 0.435  # of a picture 60 degrees wide, 4:3: other views turn a little more or less
FIXATION_NOISE = 0.001  # of the picture's side
BLINK = 0.15  # s


def wave(t, seconds):
    """A swing of 1 that begins at 0."""
    return math.sin(2 * math.pi * t / seconds)


# Heads: position (m), yaw (left > 0) and pitch (up > 0), degrees.

def seated(t):
    return (0.02 * wave(t, 3.7), 0.004 * wave(t, 2.3), 0.015 * wave(t, 5.1)), 9 * wave(t, 6.1), 3.5 * wave(t, 4.3)


def walk(t):
    """A few steps to a side and back, 1.8 a second: each bobs, each second one sways."""
    step = 1 / 1.8
    position = (0.2 * wave(t, 10) + 0.02 * wave(t, 2 * step), 0.018 * wave(t, step),
                -0.12 * (1 - math.cos(2 * math.pi * t / 10)))
    return position, 4 * wave(t, 5.3) + 0.8 * wave(t, 2 * step), 2 * wave(t, 7.1) + 0.6 * wave(t, step)


def bent_over_a_page(t):
    return (0.002 * wave(t, 4.1), 0.001 * wave(t, 2.9), 0.003 * wave(t, 5.3)), 0.6 * wave(t, 3.3), 0.3 * wave(t, 4.7)


def still(t):
    return (0.0, 0.0, 0.0), 0.0, 0.0


# Gazes: fixations as (from second, yaw, pitch), degrees in the world; a saccade leads to each.

def look_around(noise, yaw, pitch):
    """Rests of 0.25 to 1.1 s in directions up to `yaw` and `pitch` from the middle."""
    fixations = [(0.0, 0.0, 0.0)]
    while fixations[-1][0] < SECONDS:
        start = fixations[-1][0] + noise.uniform(0.25, 1.1)
        fixations.append((start, noise.uniform(-yaw, yaw), noise.uniform(-pitch, pitch)))
    return fixations


def lines_of_text(noise):
    """Lines 18 degrees wide, 1.5 apart; rests of 0.2 to 0.28 s some 2 degrees apart, one step in eight goes back."""
    fixations, t, line, x = [], 0.0, 0, 9.0
    while t < SECONDS:
        fixations.append((t, x + noise.gauss(0, 0.2), 5 - 1.5 * line))
        t += noise.uniform(0.2, 0.28)
        x -= -1.5 if noise.random() < 0.125 and x < 7 else noise.uniform(1.6, 2.6)
        if x < -9:
            line, x = line + 1, 9.0
    return fixations


def saccade_seconds(degrees):
    # Bahill, Clark, Stark 1975: the main sequence
    return 0.021 + 0.0022 * degrees


def direction(fixations, t):
    place = fixations[0][1:]
    for (start, *to) in fixations[1:]:
        if t < start:
            break
        s = min((t - start) / saccade_seconds(math.dist(place, to)), 1.0)
        place = tuple(a + (b - a) * s * s * (3 - 2 * s) for a, b in zip(place, to))
    return place


def seen(yaw, pitch, head):
    """Where a direction of the world, far away, is in the picture."""
    _, head_yaw, head_pitch = head
    x = math.tan(math.radians(yaw - head_yaw)) / TAN_HALF_X
    y = math.tan(math.radians(pitch - head_pitch)) / TAN_HALF_Y
    return 0.5 - 0.5 * x, 0.5 - 0.5 * y


def rests(fixations, head):
    return lambda t: seen(*direction(fixations, t), head(t))


def sweep(t):
    """From below, where things are near, to above and back, slow enough to be followed; no saccade."""
    return 0.5 + 0.38 * math.sin(2 * math.pi * t / 7.3), 0.5 + 0.4 * math.cos(2 * math.pi * t / 5)


TRACES = [
    ("seated", "A seated viewer looks around.", seated,
     lambda noise: rests(look_around(noise, 22, 14), seated), [(3.1, BLINK), (7.4, BLINK)]),
    ("walk", "Steps to a side and back, the gaze ahead.", walk,
     lambda noise: rests(look_around(noise, 10, 7), walk), [(4.6, BLINK)]),
    ("reading", "Lines of text: small saccades, return sweeps.", bent_over_a_page,
     lambda noise: rests(lines_of_text(noise), bent_over_a_page), [(5.2, BLINK)]),
    ("sweep", "The gaze moves slowly from near to far and back, the head rests.", still, lambda noise: sweep, []),
    ("dropouts", "A seated viewer looks around, and the tracker loses the gaze for 0.1 to 3 s.", seated,
     lambda noise: rests(look_around(noise, 20, 12), seated),
     [(0.8, 0.1), (1.5, BLINK), (2.2, 0.3), (3.3, 1.0), (4.8, BLINK), (5.1, 0.1), (5.6, 3.0), (9.3, 0.5)]),
]


def number(value, digits):
    text = "%.*f" % (digits, value)
    return text.lstrip("-") if float(text) == 0 else text


def head_rows(head):
    hz = HEAD_HZ if head is not still else 1 / SECONDS
    for i in range(round(SECONDS * hz) + 1):
        position, yaw, pitch = head(i / hz)
        yaw, pitch = math.radians(yaw) / 2, math.radians(pitch) / 2
        turn = (math.cos(yaw) * math.sin(pitch), math.sin(yaw) * math.cos(pitch), -math.sin(yaw) * math.sin(pitch),
                math.cos(yaw) * math.cos(pitch))
        yield ",".join([number(i / hz, 4)] + [number(v, 5) for v in position + turn])


def gaze_rows(gaze, lost, noise):
    for i in range(round(SECONDS * GAZE_HZ) + 1):
        t = i / GAZE_HZ
        x, y = (p + noise.gauss(0, FIXATION_NOISE) for p in gaze(t))
        is_lost = any(start <= t < start + seconds for start, seconds in lost)
        yield number(t, 4) + (",nan,nan,0" if is_lost else ",%s,%s,1" % (number(x, 4), number(y, 4)))


def write(folder):
    for seed, (name, what, head, gaze, lost) in enumerate(TRACES):
        noise = random.Random(seed)
        for kind, header, rows in [("head", "t_s,x,y,z,qx,qy,qz,qw", head_rows(head)),
                                   ("gaze", "t_s,x,y,valid", gaze_rows(gaze(noise), lost, noise))]:
            lines = ["# " + what, header, *rows]
            (folder / ("%s.%s.csv" % (name, kind))).write_text("\n".join(lines) + "\n")
