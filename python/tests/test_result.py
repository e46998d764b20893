"""Results: values, histories, files."""

import json
import os
import subprocess
import warnings

import auxbear
import numpy
import pytest
from conftest import SCENARIOS


def test_a_result_is_a_number_with_unit_and_law(result):
    force = result["first_impact_force"]
    assert force.unit == "N" and force.law
    assert float(force) == force.value > 100.0
    assert result["whirl_direction"].value
    assert list(result) == list(result.summary["quantities"])


def test_numbers_are_those_of_the_summary_bit_for_bit(result):
    for name, quantity in result.items():
        told = result.summary["quantities"][name]
        assert told["value"] == quantity.value, name
        assert (told["unit"], told.get("why")) == (quantity.unit, quantity.why)


def test_what_has_no_value_says_why(result):
    absent = [quantity for quantity in result.values() if quantity.value is None]
    assert absent
    with pytest.raises(ValueError, match=absent[0].name):
        float(absent[0])
    with pytest.raises(KeyError, match="first_impact_force"):
        result["first_impact_forces"]


def test_lists_are_arrays(result):
    starts = numpy.asarray(result["contact_start_times"])
    assert starts.shape == (int(float(result["contact_count"])),)
    assert (numpy.diff(starts) > 0).all()


def test_warnings_are_python_warnings_too(drop):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = drop.run()
    codes = [str(warning.message).split(":")[0] for warning in caught]
    assert codes == [warning.code for warning in result.warnings]
    words = ("destroys", "invalid", "uncertain", "note")
    assert all(warning.severity in words and warning.text for warning in result.warnings)


def test_a_history_goes_to_readers_of_arrow(result):
    polars, pyarrow = pytest.importorskip("polars"), pytest.importorskip("pyarrow")
    history = result.history
    assert history.columns[0] == "time" and history.units["time"] == "s"
    frame = polars.DataFrame(history)
    assert frame.columns == history.columns and len(frame) == len(history) > 10
    table = pyarrow.table(history)
    assert table.schema.field("time").metadata[b"unit"] == b"s"
    for name in history:
        numpy.testing.assert_array_equal(history[name], frame[name].to_numpy())
    del history, result
    assert frame["time"].is_sorted()


def test_a_history_goes_to_pandas(result):
    pandas = pytest.importorskip("pandas")
    frame = result.to_pandas()
    assert list(frame.columns) == result.history.columns
    assert frame.attrs["units"]["time"] == "s"
    pandas.testing.assert_frame_equal(pandas.DataFrame(dict(result.history)), frame)
    for wrong in (pandas.DataFrame, numpy.asarray):
        with pytest.raises(TypeError, match="to_pandas"):
            wrong(result.history)


def test_a_run_directory_is_that_of_the_command(drop, result, tmp_path):
    result.write(tmp_path / "run")
    names = sorted(path.name for path in (tmp_path / "run").iterdir())
    assert names == ["history.parquet", "report.html", "scenario.toml", "summary.json"]
    summary = json.loads((tmp_path / "run/summary.json").read_text(encoding="utf-8"))
    assert summary == result.summary
    with pytest.raises(auxbear.Problem):
        result.write(tmp_path / "run")
    command = os.environ.get("AUXBEAR_COMMAND")
    if not command:
        pytest.skip("AUXBEAR_COMMAND names no command to compare with")
    file = tmp_path / "drop.toml"
    file.write_text(drop.toml(), encoding="utf-8")
    out = tmp_path / "command"
    subprocess.run([command, "run", file, "--quiet", "--out", out], check=True, capture_output=True)
    theirs = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert theirs["quantities"] == result.summary["quantities"]
    parquet = [(place / "history.parquet").read_bytes() for place in (out, tmp_path / "run")]
    assert parquet[0] == parquet[1]


def test_a_report_and_a_notebook_show_it(result, tmp_path):
    result.report(tmp_path / "report.html")
    assert "<html" in (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "first_impact_force" in result._repr_html_()


def test_repeated_runs_have_members_and_spread(drop):
    repeated = drop.run(repeat=8)
    assert len(repeated.members) == 8
    forces = repeated.members["first_impact_force"]
    assert forces[0] == float(repeated["first_impact_force"])
    assert repeated["first_impact_force"].spread.members == 8
    assert drop.run().members is None


def test_a_result_computes_compares_and_formats(result):
    force, time = result["first_impact_force"], result["time_to_first_contact"]
    value = float(force)
    assert force + 1 == 1 + force == value + 1 and 2 * force == force + force and force - 1.0 == -(1.0 - force)
    assert force / 2 == value / 2 and force * time == value * float(time) and force**2 == value**2
    assert force > "1 N" and force < "1e9 N" and not force > value and force == value and force != value + 1
    assert f"{force:.1f}" == f"{value:.1f}" and f"{force}".endswith(" N") and round(force, 1) == round(value, 1)
    assert max(force, result["peak_contact_force"]) is not None and abs(force) == abs(value)
    numpy.testing.assert_array_equal(force * numpy.arange(3.0), value * numpy.arange(3.0))
    with pytest.raises(TypeError, match="is in N"):
        force + time
    with pytest.raises(ValueError, match="quantity in N"):
        force > "1 m"
    assert force != time and force != "no number" and result["whirl_direction"] == result["whirl_direction"].value


def test_names_are_completed(drop, result):
    assert result._ipython_key_completions_() == list(result)
    assert {"first_impact_force", "history", "stop"} <= set(dir(result))
    assert result.first_impact_force == result["first_impact_force"]
    history = result.history
    assert history._ipython_key_completions_() == history.columns
    assert {"time", "rotor", "bearing"} <= set(dir(history))
    assert {"cage", "inner_race"} <= set(dir(history.bearing))
    assert (history.bearing.inner_race.speed == history["bearing.inner_race.speed"]).all()
    with pytest.raises(AttributeError):
        history.bearing.inner_rice
    assert not hasattr(result, "_repr_latex_")


def test_names_of_several_bearings_are_completed_by_bearing():
    scenario = auxbear.Scenario.load(SCENARIOS / "two_bearings_drop.toml")
    result = scenario.set("run.duration", "2 ms").run()
    bearing = next(name.partition(".")[0] for name in result if name.endswith(".peak_contact_force"))
    part = getattr(result, bearing)
    assert "peak_contact_force" in dir(part)
    assert part.peak_contact_force.name == f"{bearing}.peak_contact_force"


def test_results_and_columns_are_known_before_a_run(drop, result):
    assert [of.name for of in drop.results()] == list(result)
    assert all(of.unit == result[of.name].unit and of.meaning for of in drop.results())
    history = result.history
    assert drop.columns() == [(name, history.units[name], history.meanings[name]) for name in history]


def test_a_summary_has_the_keys_of_its_schema(result):
    schema = json.loads(auxbear.schema("summary"))
    assert set(result.summary) <= set(schema["properties"])
