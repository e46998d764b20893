"""The standard pictures of a run as Plotly figures. Plotly is needed for them alone: ``pip install plotly``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import plotly.graph_objects

    from auxbear.result import Result

#: Picture: title, axis, unit of the axis and its factor, and the columns with their names.
_HISTORIES: dict[str, tuple[str, str, float, list[tuple[str, str]]]] = {
    "force": (
        "Contact of rotor and inner race",
        "force [N]",
        1.0,
        [("contact.force", "normal force"), ("contact.friction_force", "friction force"), ("mount.force", "mount")],
    ),
    "speed": (
        "Speeds",
        "speed [rpm]",
        9.549296585513721,
        [("rotor.speed", "rotor"), ("inner_race.speed", "inner race"), ("cage.speed", "cage")],
    ),
    "load": ("Load of the bearing", "load [N]", 1.0, [("bearing.load", "load of the balls")]),
    "moment": (
        "Moments that brake",
        "moment [N mm]",
        1e3,
        [
            ("inner_race.resisting_moment", "inner race"),
            ("outer_race.moment", "outer race"),
            ("speed_dependent.moment", "by speed"),
            ("load_dependent.moment", "by load"),
        ],
    ),
    "clearance": ("Diametral clearance of the bearing", "clearance [µm]", 1e6, [("bearing.clearance", "clearance")]),
}

#: All pictures.
PICTURES = ["orbit", *_HISTORIES, "temperature", "heat"]


def figure(result: Result, picture: str, bearing: str | None = None) -> plotly.graph_objects.Figure:
    """The picture of a name in :data:`PICTURES`; ``bearing`` names one of several auxiliary bearings.

    Raises ``KeyError`` for a name that is not known, ``ValueError`` where the run has nothing to show in it.
    """
    try:
        import plotly.graph_objects as graph
    except ImportError as error:
        raise ImportError("figures need Plotly: pip install plotly") from error
    if picture not in PICTURES:
        raise KeyError(f"no picture {picture!r}: there are {', '.join(PICTURES)}")
    if picture == "orbit":
        made = _orbit(graph, result, bearing)
    elif picture == "temperature":
        nodes = [(name, name.removesuffix(".temperature").replace("_", " ")) for name in _ending(result, ".temperature")]
        made = _over_time(graph, result, "Temperatures", "temperature [°C]", nodes, lambda values: values - 273.15)
    elif picture == "heat":
        heats = [(name, name.rsplit("energy.heat.", 1)[1].replace("_", " ")) for name in _holding(result, "energy.heat.")]
        made = _over_time(graph, result, "Heat", "energy [J]", heats, lambda values: values)
    else:
        title, axis, factor, wanted = _HISTORIES[picture]
        columns = [(name, words) for end, words in wanted for name in _ending(result, end) if _of(name, bearing)]
        made = _over_time(graph, result, title, axis, columns, lambda values: factor * values)
    if made is None:
        raise ValueError(f"this run has nothing to show in {picture!r}")
    made.update_layout(template="plotly_white", title_text=made.layout.title.text, legend_title_text=None)
    return made


def _ending(result: Result, end: str) -> list[str]:
    return [name for name in result.history.columns if name == end or name.endswith("." + end.lstrip("."))]


def _holding(result: Result, part: str) -> list[str]:
    return [name for name in result.history.columns if part in name]


def _of(name: str, bearing: str | None) -> bool:
    return bearing is None or name.startswith(f"{bearing}.") or name.startswith("rotor.")


def _instants(result: Result) -> list[tuple[float, str]]:
    """Instants worth a mark, with their words, as the tables of results place them in figures."""
    quantities: dict[str, Any] = result.summary["quantities"]
    shown = [(of.get("value"), of.get("shown", {})) for of in quantities.values()]
    release = next((value for value, words in shown if words.get("instants") == "release"), None) or 0.0
    # the axis of time begins with the run
    starts = {"instants": 0.0, "instants_after_release": release}
    found = [(value + starts[figure], words[figure]) for value, words in shown if value for figure in starts if figure in words]
    return [(at, words) for at, words in found if at > 0.0]


def _over_time(graph: Any, result: Result, title: str, axis: str, columns: list[tuple[str, str]], shown: Any) -> Any:
    history = result.history
    if not columns or "time" not in history:
        return None
    times = history["time"]
    span = float(times[-1]) if len(times) else 0.0
    factor, unit = (1e3, "ms") if span < 2.0 else (1.0, "s") if span < 7200.0 else (1.0 / 3600.0, "h")
    several = len({name.split(".")[0] for name, _ in columns}) > 1 and len({words for _, words in columns}) < len(columns)
    made = graph.Figure()
    for name, words in columns:
        label = f"{name.split('.')[0]}: {words}" if several else words
        made.add_scatter(x=factor * times, y=shown(history[name]), mode="lines", name=label)
    for at, words in _instants(result):
        # upright words do not meet those of the next instant
        made.add_vline(
            x=factor * at,
            line_width=1,
            line_dash="dot",
            line_color="#6b7680",
            annotation_text=words,
            annotation_textangle=-90,
            annotation_position="bottom right",
            annotation_font_size=10,
        )
    made.update_yaxes(exponentformat="none", separatethousands=True)
    made.update_layout(title_text=title, xaxis_title=f"time [{unit}]", yaxis_title=axis, showlegend=len(columns) > 1)
    return made


def _orbit(graph: Any, result: Result, bearing: str | None) -> Any:
    history = result.history
    start = f"{bearing}." if bearing else ""
    xs = next((name for name in history.columns if name.endswith("rotor.x") and name.startswith(start)), None)
    if xs is None:
        return None
    ys = xs[:-1] + "y"
    made = graph.Figure()
    made.add_scatter(x=1e6 * history[xs], y=1e6 * history[ys], mode="lines", name="rotor's centre", line_width=1)
    clearance = _clearance(result, bearing)
    if clearance is not None:
        radius = 1e6 * clearance
        x, y = (1e6 * float(history[xs.removesuffix("rotor.x") + f"bearing.inner_race.{axis}"][0]) for axis in "xy")
        made.add_shape(type="circle", x0=x - radius, y0=y - radius, x1=x + radius, y1=y + radius, line_color="#b3261e", line_dash="dot")
    words = "dotted: air clearance of a race at rest" if clearance is not None else None
    made.update_layout(title_text="Orbit of the rotor", title_subtitle_text=words, xaxis_title="x [µm]", yaxis_title="y [µm]")
    made.update_xaxes(constrain="domain")
    made.update_yaxes(scaleanchor="x", scaleratio=1, constrain="domain")
    return made


def _clearance(result: Result, bearing: str | None) -> float | None:
    summary = result.summary
    for part in summary.get("auxiliary_bearings", []):
        if bearing is None or part.get("name") == bearing:
            return part.get("clearance_radius_m")
    return summary.get("clearance_radius_m")
