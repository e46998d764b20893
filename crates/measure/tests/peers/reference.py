"""Reference numbers for the readers, by npTDMS and pyuff.

    pip install npTDMS pyuff numpy
    python reference.py tdms FILE... > ../data/tdms.txt
    python reference.py uff FILE... > ../data/uff.txt

Writes, for each channel: file, name, count, unit, interval, and the values themselves as a checksum and a few samples.
The checksum is FNV-1a (64 bits) over the little-endian doubles, so that it covers every sample bit by bit.
Columns are separated by tabs; '#' begins a remark. Used in development only: the tests need no Python.
"""

import os
import sys

import numpy as np


def checksum(values):
    h = 0xCBF29CE484222325
    for byte in np.asarray(values, dtype="<f8").tobytes():
        h = ((h ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return f"{h:016x}"


def row(path, name, unit, interval, values):
    values = np.asarray(values, dtype=float)
    samples = [values[i] for i in (0, len(values) // 3, len(values) - 1)] if len(values) else []
    print("\t".join([os.path.basename(path), name, str(len(values)), unit, repr(float(interval)), checksum(values)]
                    + [repr(float(s)) for s in samples]))


def tdms(paths):
    import nptdms
    print(f"# npTDMS {nptdms.__version__}")
    for path in paths:
        file = nptdms.TdmsFile.read(path)
        for group in file.groups():
            for channel in group.channels():
                values = channel[:] if len(channel) else []
                if len(channel) and np.asarray(values).dtype.kind == "M":
                    values = (values - values[0]) / np.timedelta64(1, "us") * 1e-6
                p = channel.properties
                row(path, f"{group.name}/{channel.name}", str(p.get("unit_string", "")), p.get("wf_increment", 0), values)


def uff(paths):
    import pyuff
    print(f"# pyuff {getattr(pyuff, '__version__', '')}")
    for path in paths:
        file = pyuff.UFF(path)
        sets = [i for i, t in enumerate(file.get_set_types()) if int(t) == 58]
        for number, i in enumerate(sets):
            d = file.read_sets(i)
            data = np.asarray(d["data"])
            x = np.asarray(d["x"])
            name = f"{number}"
            step = d.get("abscissa_inc", 0)
            unit = str(d.get("ordinate_axis_units_lab", "")).strip()
            if data.dtype.kind == "c":
                row(path, name + " real", unit, step, data.real)
                row(path, name + " imaginary", unit, step, data.imag)
            else:
                row(path, name, unit, step, data)
            if int(d.get("abscissa_spacing", 1)) == 0:
                row(path, name + " abscissa", str(d.get("abscissa_axis_units_lab", "")).strip(), 0, x)


{"tdms": tdms, "uff": uff}[sys.argv[1]](sys.argv[2:])
