"""The standard pictures."""

import auxbear
import pytest
from auxbear import figures


def test_a_name_that_is_no_picture_is_told(result):
    pytest.importorskip("plotly")
    with pytest.raises(KeyError, match="orbit, force"):
        result.figure("orbits")
    with pytest.raises(ValueError, match="temperature"):
        result.figure("temperature")


def test_pictures_have_units_and_the_values_of_the_history(result):
    pytest.importorskip("plotly")
    force = result.figure("force")
    assert force.layout.xaxis.title.text == "time [ms]" and force.layout.yaxis.title.text == "force [N]"
    assert list(force.data[0].y) == list(result.history["bearing.contact.force"])
    orbit = result.figure("orbit")
    assert orbit.layout.yaxis.scaleanchor == "x" and len(orbit.layout.shapes) == 1
    assert abs(orbit.layout.shapes[0].x1 - 250.0) < 1e-9
    marks = [mark.text for mark in force.layout.annotations]
    assert "first contact" in marks


def test_a_run_out_shows_its_temperatures():
    pytest.importorskip("plotly")
    run = auxbear.Scenario.parse(auxbear.template("coast_down")).run()
    shown = run.figure("temperature")
    assert shown.layout.yaxis.title.text == "temperature [°C]"
    assert 20.0 < max(shown.data[0].y) < 100.0
    assert {"clearance", "moment"} <= set(figures.PICTURES)
    assert len(run.figure("clearance").data) == 1
