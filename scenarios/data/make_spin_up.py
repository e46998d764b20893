"""Writes spin_up.tdms, a made-up measurement for scenarios/signals_spin_up.toml. Nothing in it was measured.

    python3 scenarios/data/make_spin_up.py

A shaft rests for 0.3 s, is brought to 150 rad/s within 40 ms with a peak of 7200 rad/s², and then slows down by 3 rad/s².
Channels:

    rig/tacho       V,     10 000 a second, 60 marks whose places are off by 0.3 % of a pitch rms
    rig/ball_pass   V,     10 000 a second, 10 balls; the cage lags while the shaft speeds up, then slips by 0.4 %
    rig/torque      N mm,  500 a second, through an arm of 30 Hz and damping ratio 0.2, with 4 N mm once a turn, noise of
                           1 N mm rms, and a zero of 2 N mm

The truth stands in crates/auxbear/tests/signals.rs too, which holds the results against it.
"""

import math
import random
import struct
from pathlib import Path

DURATION, RATE, TORQUE_RATE = 1.5, 10_000, 500
ENGAGED, LENGTH, PEAK, RISE, FULL = 0.3, 0.040, 7200.0, 0.001, 150.0
SLOWING = 3.0
FALL = PEAK * (LENGTH - RISE) / (FULL - 0.5 * PEAK * RISE) - 1.0
MARKS, BALLS, RATIO, SLIP = 60, 10, 0.4, 0.004
SENSOR, DAMPING, SYNCHRONOUS, NOISE, ZERO = 30.0, 0.2, 4.0, 1.0, 2.0


def acceleration(time):
    t = time - ENGAGED
    if t <= 0.0:
        return 0.0
    if t >= LENGTH:
        return -SLOWING
    if t < RISE:
        return PEAK * t / RISE
    return PEAK * (1.0 - (t - RISE) / (LENGTH - RISE)) ** FALL


def torque(time, speed):
    """Friction of a greased bearing less the inertia of its balls, N mm, as a torque arm on the outer race feels it."""
    if time <= ENGAGED:
        return 0.0
    return 3.0 + 22.0 * (max(speed, 2.0) / FULL) ** (2.0 / 3.0) - 12.9 / 11_500.0 * acceleration(time)


def motion():
    """Angle of the shaft and of the cage, speed, and reading of the arm, at 16 steps for each sample of the pickup."""
    parts = 16
    dt = 1.0 / (RATE * parts)
    angle = speed = cage = reading = rate = 0.0
    omega = 2.0 * math.pi * SENSOR
    for step in range(int(DURATION * RATE * parts)):
        time = step * dt
        if step % parts == 0:
            yield step // parts, time, angle, speed, cage, reading
        # the middle of the step
        a = acceleration(time + 0.5 * dt)
        middle = speed + 0.5 * dt * a
        since = time - ENGAGED
        slip = SLIP + 0.3 * math.exp(-since / 0.05) if since > 0.0 else 0.0
        force = torque(time, speed) + SYNCHRONOUS * (speed / FULL) ** 2 * math.cos(angle + 0.7)
        rate += dt * (omega * omega * (force - reading) - 2.0 * DAMPING * omega * rate)
        reading += dt * rate
        angle += dt * middle
        cage += dt * middle * RATIO * (1.0 - slip)
        speed += dt * a


def wave(angle, count, errors):
    """A pickup's voltage over `count` marks a turn."""
    place = count * angle / (2.0 * math.pi) + 0.37
    off = errors[int(place) % count] if errors else 0.0
    return 2.5 + 2.4 * math.tanh(3.0 * math.sin(2.0 * math.pi * (place + off)))


def text(value):
    data = value.encode()
    return struct.pack("<I", len(data)) + data


def tdms(channels):
    """One segment of TDMS: name, unit, interval, values in single precision."""
    objects = text("/") + struct.pack("<II", 0xFFFFFFFF, 1)
    objects += text("remark") + struct.pack("<I", 0x20) + text("made up: see make_spin_up.py")
    objects += text("/'rig'") + struct.pack("<II", 0xFFFFFFFF, 0)
    raw = b""
    for name, unit, interval, values in channels:
        objects += text(f"/'rig'/'{name}'") + struct.pack("<IIIQ", 20, 9, 1, len(values))
        objects += struct.pack("<I", 3)
        objects += text("unit_string") + struct.pack("<I", 0x20) + text(unit)
        objects += text("wf_increment") + struct.pack("<Id", 10, interval)
        objects += text("wf_start_offset") + struct.pack("<Id", 10, 0.0)
        raw += struct.pack(f"<{len(values)}f", *values)
    objects = struct.pack("<I", len(channels) + 2) + objects
    return b"TDSm" + struct.pack("<IIQQ", 14, 4713, len(objects) + len(raw), len(objects)) + objects + raw


def main():
    chance = random.Random(2026)
    errors = [chance.gauss(0.0, 0.003) for _ in range(MARKS)]
    step = 20.0 / 2**14
    rounded = lambda volts: step * round(volts / step)
    tacho, balls, arm = [], [], []
    for k, _, angle, _, cage, reading in motion():
        tacho.append(rounded(wave(angle, MARKS, errors) + chance.gauss(0.0, 0.02)))
        balls.append(rounded(wave(cage, BALLS, []) + chance.gauss(0.0, 0.02)))
        if k % (RATE // TORQUE_RATE) == 0:
            arm.append(reading + ZERO + chance.gauss(0.0, NOISE))
    channels = [
        ("tacho", "V", 1.0 / RATE, tacho),
        ("ball_pass", "V", 1.0 / RATE, balls),
        ("torque", "N mm", 1.0 / TORQUE_RATE, arm),
    ]
    Path(__file__).with_name("spin_up.tdms").write_bytes(tdms(channels))


main()
