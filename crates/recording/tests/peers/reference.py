"""Reference numbers for the readers, by npTDMS and pyuff.

    pip install npTDMS pyuff numpy
    python reference.py tdms FILE... > ../data/tdms.txt
    python reference.py uff FILE... > ../data/uff.txt
    python reference.py uff-samples ../data; python reference.py uff ../data/*.uff > ../data/uff_samples.txt

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


def uff_samples(folders):
    """Small files as pyuff writes them: text and bytes, real and complex, even and uneven."""
    import pyuff
    n = 11
    t = np.arange(n) * 0.25
    real = np.cos(3 * t) * 10.0 ** np.arange(-5, 6)
    for kind, data, code in [("real", real, 4), ("complex", real + 1j * real[::-1], 6)]:
        for spacing in ("even", "uneven"):
            x = t if spacing == "even" else np.arange(n) ** 2 * 0.5
            for binary in (0, 1):
                name = f"{folders[0]}/{kind}_{spacing}_{'binary' if binary else 'text'}.uff"
                if os.path.exists(name):
                    os.remove(name)
                pyuff.UFF(name)._write_set({
                    "type": 58, "binary": binary, "func_type": 1, "id1": "run 7", "id2": "NONE",
                    "id3": "18-Apr-16 13:49:58", "id4": "NONE", "id5": "NONE", "rsp_ent_name": "rotor",
                    "rsp_node": 7, "rsp_dir": 3, "ref_node": 0, "ref_dir": 0, "ref_ent_name": "NONE", "data": data, "x": x,
                    "ver_num": 0, "load_case_id": 0, "ord_data_type": code, "num_pts": n,
                    "abscissa_spacing": int(spacing == "even"), "abscissa_min": 0.0, "abscissa_inc": 0.25, "z_axis_value": 0.0,
                    "abscissa_spec_data_type": 17, "abscissa_axis_lab": "time", "abscissa_axis_units_lab": "s",
                    "ordinate_spec_data_type": 12, "ordinate_axis_lab": "acceleration", "ordinate_axis_units_lab": "m/s^2",
                    **{f"{axis}_{key}": value for axis in ("abscissa", "ordinate", "orddenom", "z_axis")
                       for key, value in (("len_unit_exp", 0), ("force_unit_exp", 0), ("temp_unit_exp", 0))},
                    **{f"{axis}_{key}": value for axis in ("orddenom", "z_axis")
                       for key, value in (("spec_data_type", 0), ("axis_lab", "NONE"), ("axis_units_lab", "NONE"))},
                }, "add")  # "overwrite" of this version loses binary sets


{"tdms": tdms, "uff": uff, "uff-samples": uff_samples}[sys.argv[1]](sys.argv[2:])
