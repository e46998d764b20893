"""Writes the small files of tests/data/peers with the libraries that labs use.

Run once, by hand: python make_tables.py DIRECTORY
Needs numpy, scipy, h5py, pandas, pyarrow; the versions used are written to versions.txt beside the files.
Values follow formulas of whole numbers and eighths, so that every format holds them exactly and the tests in Rust
need no second list of them:  wave(k) = (k² mod 97) / 8 - 6,  ramp(k) = 3 k - 50.
"""

import sys
from pathlib import Path

import h5py
import numpy as np
import pandas
import pyarrow
import pyarrow.parquet
import scipy
import scipy.io


def wave(n):
    k = np.arange(n, dtype=np.int64)
    return (k * k % 97) / 8 - 6


def ramp(n):
    return 3 * np.arange(n, dtype=np.int64) - 50


def hdf5(path, libver):
    n = 400
    with h5py.File(path, "w", libver=libver) as f:
        f.attrs["operator"] = "nobody"
        f.attrs["load"] = 12.5
        many = f.create_group("many")
        for g in range(12):
            many[f"short{g:02}"] = ramp(3) + g
        for group in [f.create_group("run")]:
            group.attrs["sampling_rate"] = 1000.0
            d = group.create_dataset("plain", data=wave(n))
            d.attrs["unit"] = "N"
            d.attrs["description"] = "force on the arm"
            d = group.create_dataset("packed", data=ramp(n), chunks=(64,), compression="gzip", shuffle=True, fletcher32=True)
            d.attrs["units"] = np.bytes_("rpm")
            d.attrs["dt"] = 0.5
            group.create_dataset("lzf", data=wave(n), chunks=(300,), compression="lzf")
            group.create_dataset("big_endian", data=ramp(n).astype(">i2"))
            group.create_dataset("half", data=wave(n).astype("<f2"))
            group.create_dataset("single", data=wave(n).astype(">f4"))
            group.create_dataset("small", data=wave(5))
            d = group.create_dataset("growing", shape=(0,), maxshape=(None,), chunks=(16,), dtype="f8")
            d.resize((n,))
            d[:] = wave(n)
            d = group.create_dataset("growing_packed", shape=(n,), maxshape=(None,), chunks=(4,), dtype="f8", compression="gzip")
            d[:] = wave(n)
            both = np.stack([wave(n), ramp(n).astype(float)], axis=1)
            group.create_dataset("columns", data=both)
            d = group.create_dataset("columns_chunked", data=both, chunks=(100, 1), maxshape=(None, None), compression="gzip")
            d = group.create_dataset("rows_chunked", data=both.T.copy(), chunks=(2, 7))
            group.create_dataset("one_chunk", data=wave(n), chunks=(n,), compression="gzip")
            if libver == "latest":
                bytes_ = (ramp(9000) % 251).astype("u1")
                group.create_dataset("paged", data=bytes_[:1500], chunks=(1,))
                group.create_dataset("paged_growing", data=bytes_, chunks=(1,), maxshape=(None,))
            d = group.create_dataset("gaps", shape=(100,), chunks=(10,), dtype="f8", fillvalue=7.0)
            d[20:30] = 1.0
            d[99] = 2.0
            table = np.zeros(n, dtype=[("a", "<f4"), ("b", ">i4"), ("text", "S3")])
            table["a"], table["b"] = wave(n), ramp(n)
            group.create_dataset("table", data=table)
            group.create_dataset("words", data=np.array([b"a", b"b"]))
            group.create_dataset("cube", data=np.zeros((2, 3, 4)))
            group["flags"] = np.arange(10) % 2 == 0
            group["scalar"] = 2.5
            timed = f.create_group("timed")
            d = timed.create_dataset("time", data=np.arange(n) * 0.25)
            d.attrs["unit"] = "ms"
            timed.create_dataset("signal", data=wave(n))
            for k in range(20):
                d.attrs[f"attribute {k:02}"] = k


def links(path):
    """Two hundred links in one group, so that heap and tree have more than one level; links out of the file and to nothing.
    Chunks with a sum and no packing, so that nothing else shows a changed value."""
    with h5py.File(path, "w", libver="latest") as f:
        f["force"] = wave(20)
        f.create_dataset("summed", data=ramp(96).astype("f8"), chunks=(32,), fletcher32=True)
        many = f.create_group("many")
        for k in range(200):
            many[f"alias {k:03}"] = h5py.SoftLink("/force")
        f["elsewhere"] = h5py.ExternalLink("other.h5", "/force")
        f["nowhere"] = h5py.SoftLink("/many/force")
        f["/".join(["deep"] * 40 + ["speed"])] = ramp(20)
        f["/".join(["below"] * 70 + ["speed"])] = ramp(20)


def mat73(path):
    n = 300
    with h5py.File(path, "w", userblock_size=512) as f:
        def put(name, value, kind, where=f):
            value = np.asarray(value)
            d = where.create_dataset(name, data=value.T)
            d.attrs["MATLAB_class"] = np.bytes_(kind)
        put("torque", wave(n)[:, None], "double")
        put("row", ramp(n).astype("i2")[None, :], "int16")
        put("both", np.stack([wave(n), ramp(n).astype(float)], axis=1), "double")
        put("t", (np.arange(n) * 0.125)[:, None], "double")
        put("fs", np.array([[8.0]]), "double")
        put("note", np.array([[ord(c) for c in "6008 µ"]], dtype="u2"), "char")
        run = f.create_group("run")
        run.attrs["MATLAB_class"] = np.bytes_("struct")
        put("speed", wave(n)[:, None], "double", run)
    data = bytearray(path.read_bytes())
    head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Jan  1 00:00:00 2024 HDF5 schema 1.00 ."
    data[:124] = head.ljust(124)
    data[124:128] = b"\x00\x02IM"
    path.write_bytes(data)


def mat5(path, packed):
    n = 300
    run = {"speed": wave(n), "inner": {"unit": "rad/s", "count": 3.0}, "list": np.array([1, 2], dtype="u1")}
    cell = np.empty((1, 2), dtype=object)
    cell[0, 0], cell[0, 1] = wave(4), "text"
    scipy.io.savemat(path, {
        "torque": wave(n)[:, None],
        "row": ramp(n).astype("i2"),
        "both": np.stack([wave(n), ramp(n).astype(float)], axis=1),
        "single": wave(n).astype("f4"),
        "bytes": (np.arange(n) % 200).astype("u1"),
        "long": ramp(n).astype("i8"),
        "turning": wave(n) + 1j * ramp(n),
        "t": np.arange(n) * 0.125,
        "fs": 8.0,
        "flags": np.arange(10) % 2 == 0,
        "note": "6008 µ",
        "run": run,
        "cell": cell,
        "empty": np.zeros((0, 0)),
        "cube": np.zeros((2, 3, 4)),
    }, do_compression=packed, oned_as="column")


def mat5_big_endian(path):
    """By hand: scipy writes in the order of the machine only."""
    def element(kind, body):
        return int(kind).to_bytes(4, "big") + len(body).to_bytes(4, "big") + body + bytes(-len(body) % 8)
    n = 20
    flags = element(6, (6).to_bytes(4, "big") + bytes(4))
    sizes = element(5, n.to_bytes(4, "big") + (1).to_bytes(4, "big"))
    values = element(9, wave(n).astype(">f8").tobytes())
    matrix = element(14, flags + sizes + element(1, b"torque") + values)
    small = bytes([0, 1, 0, 1]) + b"x\0\0\0"
    single = element(14, flags + element(5, bytes([0, 0, 0, 3, 0, 0, 0, 1])) + small + element(3, ramp(3).astype(">i2").tobytes()))
    path.write_bytes(b"MATLAB 5.0 MAT-file, by hand".ljust(116) + bytes(8) + b"\x01\x00MI" + matrix + single)


def parquet(path, **how):
    n = 700
    t = np.arange(n) * 0.001
    gaps = [None if k % 10 == 3 else float(v) for k, v in enumerate(wave(n))]
    fields = [
        ("time", pyarrow.float64(), t, "s"),
        ("force", pyarrow.float64(), wave(n), "N"),
        ("speed", pyarrow.float32(), wave(n), "rpm"),
        ("count", pyarrow.int64(), ramp(n), ""),
        ("small", pyarrow.int16(), ramp(n) % 100, ""),
        ("unsigned", pyarrow.uint8(), np.arange(n) % 256, ""),
        ("gaps", pyarrow.float64(), gaps, "mm"),
        ("flag", pyarrow.bool_(), np.arange(n) % 2 == 0, ""),
        ("name", pyarrow.string(), [f"row {k % 7}" for k in range(n)], ""),
        ("stamp", pyarrow.timestamp("us", tz="UTC"), 1_700_000_000_000_000 + 1000 * np.arange(n), ""),
    ]
    schema = pyarrow.schema([pyarrow.field(a, b, metadata={"unit": u} if u else None) for a, b, _, u in fields])
    columns = [pyarrow.array(list(map(lambda v: v if v is None or isinstance(v, str) else v.item() if hasattr(v, "item") else v, c)), type=b) if b != pyarrow.timestamp("us", tz="UTC") else pyarrow.array(c, type=pyarrow.int64()).cast(b) for _, b, c, _ in fields]
    pyarrow.parquet.write_table(pyarrow.table(columns, schema=schema), path, row_group_size=300, **how)


def main():
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    hdf5(out / "old.h5", "earliest")
    hdf5(out / "new.h5", "latest")
    links(out / "links.h5")
    mat73(out / "v73.mat")
    mat5(out / "packed.mat", True)
    mat5(out / "plain.mat", False)
    mat5_big_endian(out / "big_endian.mat")
    parquet(out / "snappy.parquet", compression="snappy")
    parquet(out / "gzip_v2.parquet", compression="gzip", data_page_version="2.0")
    parquet(out / "plain.parquet", compression="none", use_dictionary=False)
    parquet(out / "zstd.parquet", compression="zstd")
    pandas.DataFrame({"Time [s]": np.arange(50) * 0.02, "Force [N]": wave(50)}).to_csv(out / "pandas.csv", index=False)
    pandas.DataFrame({"Zeit [s]": np.arange(50) * 0.02, "Kraft [N]": wave(50)}).to_csv(out / "german.csv", index=False, sep=";", decimal=",")
    versions = {m.__name__: m.__version__ for m in (np, scipy, h5py, pandas, pyarrow)}
    versions["HDF5"] = h5py.version.hdf5_version
    text = "".join(f"{name} {version}\n" for name, version in versions.items())
    (out / "versions.txt").write_text(text)


main()
