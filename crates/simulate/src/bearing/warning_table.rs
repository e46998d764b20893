//! Warnings of a bearing and its heat that several systems give.

use scenario::heat::ICE_POINT;
use std::f64::consts::{E, PI};

problem::warnings! {
    /// Of a bearing.
    pub enum BearingWarning {
        Pressure { pressure: "Pa", limit: "Pa" } "AB1002" Invalid, each
            ("The peak Hertz pressure of {:.0} MPa exceeds the limit of {:.0} MPa: {DENTS}.", pressure * 1e-6, limit * 1e-6);
        PressureInCoastDown { load: "N", pressure: "Pa", limit: "Pa" } "AB1002" Invalid, coast_down
            ("While it coasts down a ball presses with up to {load:.0} N, {:.0} MPa, beyond the limit of {:.0} MPa: {DENTS}.", 1e-6 * pressure, 1e-6 * limit);
        Residual { residual: "1" } "AB1006" Invalid, each
            ("The energy ledger misses {residual:.1e} of what was turned over: a smaller run.tolerance closes it.");
        NoMoment "AB1008" Note
            ("The bearing has no steady friction moment (bearing.moment.law is none): spin-up by the rotor is described; long coasting is too free, and a swing of the rotor in the bore after spin-up decays too slowly.");
        Rolls "AB1009" Uncertain
            ("The rolling bearing assumes that no ball skids: where the planar fidelity shows slip, its spin-up times and losses are not true.");
        Hybrid "AB1012" Note
            ("Silicon nitride balls on steel races: contact stiffness and ball mass follow the material; traction and damping are those given.");
        Skids { speed: "rad/s", load: "N", capacity: "1", moment: "N m" } "AB1017" Invalid, each
            ("The balls must skid: at {speed:.0} rad/s under {load:.0} N traction can carry {capacity:.2} times the friction moment of {:.1} N mm, and 1.2 times is needed. In a steady run the mean moment on the outer race is then less than that of the law.", moment.abs() * 1e3);
        MixedFilm { share: "1" } "AB1030" Uncertain, unperturbed
            ("In {:.0} % of the rows' loaded contacts the oil film is thinner at its minimum than the roughness (lambda below 1): traction is mostly boundary friction, whose coefficient is bearing.traction.boundary_friction_coefficient.", 1e2 * share);
        FilmLaw { departures: words } "AB1031" Invalid, unperturbed ("The law of the lubricant's traction has left its range: {departures}.");
        LooseFromTheStart "AB1032" Invalid, each
            ("The inner ring is said to grow with its shaft (bearing.inner_race_growth), and no interference holds it there: bearing.fits.shaft_interference is needed.");
        LiftsOff { speed: "rad/s" } "AB1032" Invalid, each
            ("The inner ring lifts off its shaft at {:.0} rpm, below the speed of this run: bearing.inner_race_growth = \"with shaft\" does not hold there, and the ring may creep.", speed * 30.0 / PI);
        WarmFilms { rise: "K", limit: "K" } "AB1035" Invalid, unperturbed
            ("The contact films warm by {rise:.0} K: drag and traction that fall exponentially with temperature hold over some {limit:.0} K, and the bulk of the bearing would warm as well.");
        Neighbours { pressure: "Pa", limit: "Pa", harm: words } "AB1070" Invalid, each
            ("Neighbouring balls press each other with {:.0} MPa, beyond their limit of {:.0} MPa: {harm}.", pressure * 1e-6, limit * 1e-6);
        CageInertia { gyration: "m", inner: "m", outer: "m" } "AB1071" Note
            ("bearing.cage_inertia and bearing.cage_mass contradict each other: together they are a ring of {:.1} mm radius, and a cage lies between the races, from {:.1} to {:.1} mm. The cage turns with the inertia and moves with the mass.", gyration * 1e3, inner * 1e3, outer * 1e3);
        AxialLoads { counted: "N", printed: words, preload: "N" } "AB1081" Uncertain
            ("The friction law counts an axial load of {counted:.0} N{printed}, the contacts an axial preload of {preload:.0} N: each holds where it is used.");
        PreloadLeft { preload: "N", limit: "N", how: words } "AB1096" Invalid, each
            ("The axial preload of {preload:.0} N keeps all balls loaded up to a radial load of {limit:.0} N: {how}. Beyond it balls are unloaded and the contact angle changes, so ball loads, pressures and spin-up times are indicative only.");
        DoubleRow "AB1125" Uncertain
            ("A double row is computed as a single row of ball_count balls: loads, pressures and friction of balls that share two rows are not those of this run.");
        HotSkid { race: text, rise: "K", time: "s", load: "N", slip: "m/s" } "AB2303" Invalid, each
            ("Where a ball skids on the {race} race, the flash temperature of their surfaces rises by {rise:.0} K ({:.4} ms: {load:.0} N, slip {slip:.1} m/s): steel is tempered and may smear there, a lubricant is burnt, and the traction of this run no longer holds.", 1e3 * time);
        WideLine { half_width: "m", bore: "m", clearance: "m" } "AB2336" Invalid, coast_down
            ("The contact of rotor and race is beyond the law of its width: half-width {:.2} mm is {:.1} % of the bore's radius (10 % at most), the radial clearance {:.2} % of it (0.1 % at least). Temperatures of the patch and the conductance between rotor and race that follow from it are extrapolated.", 1e3 * half_width, 100.0 * half_width / bore, 100.0 * clearance / bore);
    }
}

problem::warnings! {
    /// Of a bearing in space.
    pub enum SpatialWarning {
        RowUnloaded { row: "", time: "s" } "AB2411" Uncertain, each
            ("Row {row} carries nothing at {:.2} ms: its balls are held by the outer race alone, slow down against the others and skid when they are pressed again. Where rows press on each other more preload keeps them pressed.", 1e3 * time);
        RunOver { ball: "", race: words, time: "s", angle: "rad", load: "N" } "AB2412" Destroys, each
            ("The contact ellipse of ball {ball} reaches over the shoulder of the {race} groove at {:.2} ms (contact angle {:.0} deg, {load:.0} N): the stress at that edge is not computed and may be several times that of the ellipse. From there on loads and angles are those of a groove that goes on.", 1e3 * time, angle.to_degrees());
        OpenSide { row: "", time: "s", load: "N", angle: "rad" } "AB2420" Destroys, each
            ("Row {row} carries thrust on its open side: {load:.0} N on a ball at {:.2} ms, {:.0} deg beyond the bottom of its groove. An angular contact row has no shoulder there: its rings come apart, and from there on this run is that of a bearing that does not exist. Turn the row round (bearing.thrust_side, bearing.preload_spring_side), or let another one carry this thrust.", 1e3 * time, angle.to_degrees());
        SpringFree { time: "s", preload: "N", stiffness: "N/m" } "AB2418" Uncertain, each
            ("The preload spring is free at {:.2} ms: its rings have moved by the {:.0} um that it was compressed by ({preload:.0} N, {stiffness:.2e} N/m), and its rows carry nothing. More preload or a softer spring keeps them pressed.", 1e3 * time, 1e6 * preload / stiffness);
        SpringSolid { time: "s", travel: "m", force: "N" } "AB2419" Uncertain, each
            ("The preload spring is solid at {:.2} ms, after {:.0} um: thrust goes through it into a stop of assumed stiffness, up to {force:.0} N, and the rotor has moved along its axis by that much more. Choose bearing.preload_spring_side so that thrust goes into the rows that stand.", 1e3 * time, 1e6 * travel);
        HotFace { rise: "K", time: "s" } "AB2416" Destroys, each by "face_temperature_rise"
            ("Where shoulder and face rub, their surfaces warm by {rise:.0} K in the mean ({:.2} ms), edges that touch first by far more: steel softens and transforms there, the surfaces may smear or seize, and the friction coefficient of this run no longer holds.", 1e3 * time);
        NoThrust { moved: "m" } "AB2413" Invalid, each
            ("No bearing in space has a shoulder in its way (contact.gap_to_start, contact.gap_to_end): nothing stops the rotor along its axis, and it has moved by {:.2} mm.", 1e3 * moved);
        Leaves { moved: "m", key: words } "AB2421" Destroys, each
            ("Nothing stops the rotor along its axis in the direction in which it moves ({key} is not given): it has moved by {:.2} mm, farther than any rebound, and leaves its bearings. Forces and lives are not those of a machine that is held.", 1e3 * moved);
        NoFriction "AB2422" Invalid, coast_down
            ("The rotor coasts down on a bearing in space without a friction moment (bearing.moment): only slip and spin of its contacts brake it there. The coast-down comes out too long, often many times, and all temperatures too low.");
        LeavesOut { left: words } "AB2414" Uncertain
            ("Of this bearing in space are not followed: {left}.");
        ShoulderUnknown { angle: "rad" } "AB2415" Uncertain, each
            ("Whether a contact leaves its groove is not judged, since bearing.shoulder_height is not given: contact angles reach {:.0} deg.", angle.to_degrees());
    }
}

/// What a pressure beyond its limit does to steel.
pub(crate) const DENTS: &str =
    "permanent dents must be expected, and the elastic contact law is outside its range";

problem::warnings! {
    /// Of the heat of a bearing.
    pub enum HeatWarning {
        TooHot { node: text, peak: "K", time: "s", above: "K", taken: words } "AB2310" Destroys, each by "peak_inner_race_temperature"
            ("Too hot: {} at {:.0} °C after {time:.2} s, {above:.0} K above its limit, and warmer still where the heat comes in. Hardness, cage and lubricant may change there; this run does not follow that.{taken}", node.replace('_', " "), peak - ICE_POINT);
        TooHotInCoastDown { node: text, limit: "K", time: "s", when: words, others: words, peak: "K", hottest: words, taken: words } "AB2310" Destroys, coast_down by "peak_inner_race_temperature"
            ("Too hot: {node} above {:.0} °C after {when}{others}, up to {:.0} °C{hottest}. Hardness, size, cage and lubricant may change there; this run does not follow that.{taken}", limit - ICE_POINT, peak - ICE_POINT);
        RunsAway { time: "s", when: words, by: words, each: words, rate: "1/s", each_largest: words, at_largest: words, largest_rate: "1/s",
            inner: "m", balls: "m", outer: "m" } "AB2311" [RUNS_AWAY] Destroys, coast_down by "peak_inner_race_temperature" (
            "{when} its balls are preloaded {by} and every kelvin makes more heat than it takes away; a disturbance grows {E:.1} times each {each} then ({rate:.2e} 1/s), and each {each_largest} at the largest rate, at {at_largest} ({largest_rate:.2e} 1/s). To its clearance the inner ring had added {:+.1} µm, the balls {:+.1} µm, the outer ring {:+.1} µm as this began. More clearance, better cooling of the inner race, or hybrid balls keep it open.",
            1e6 * inner, 1e6 * balls, 1e6 * outer
        );
        Closes { time: "s", closed: "m" } "AB2312" [CLOSES] Invalid, each
            ("The clearance closes after {time:.3} s: rings that warm unequally press on the balls, by {:.1} µm at most. The difference of the rings' temperatures is known within a factor of two; so is the clearance that is needed.", 1e6 * closed);
        ClosesInCoastDown { time: "s", clearance: "m", when: words, load: "N" } "AB2312" Invalid, coast_down
            ("The clearance {when}: rings that warm unequally load the balls with up to {load:.0} N. The difference of the rings' temperatures is known within a factor of two; so is the clearance that is needed.");
        FollowsNoMore { time: "s", why: words } "AB2320" Uncertain, each
            ("From {time:.3} s on nothing of the bearing follows its temperatures, since no law holds there: {why}.");
        PreloadOfSprings "AB2320" Uncertain, each
            ("The contact angle follows the temperatures, and the preload does not: it is that of springs. A rigid one rises as the inner ring warms.");
        FrictionStaysAlike "AB2320" Uncertain, each
            ("No friction of the bearing follows the temperature of its lubricant: bearing.moment.viscosity_points, two temperatures with their viscosities, are not given, or its law knows no viscosity.");
        PreloadChanges { mounted: "N", least: "N", most: "N" } "AB2345" Uncertain, each by "smallest_preload"
            ("Unequal temperatures take the preload of the pair from {mounted:.0} N to between {least:.0} N and {most:.0} N at rest. The difference of the rings' temperatures is known within a factor of two; so is this change. Without preload a row is unloaded; a larger one loads and heats both rows without any impact.");
        PreloadChangesInCoastDown { mounted: "N", least: "N", most: "N" } "AB2345" Uncertain, coast_down by "smallest_preload"
            ("During the coast-down unequal temperatures take the preload of the pair from {mounted:.0} N to between {least:.0} N and {most:.0} N at rest. Without preload a row is unloaded, a larger one brakes more: the intervals follow both.");
        LooseRing { time: "s", when: words, seat: text } "AB2321" Uncertain, coast_down
            ("After {when} {seat} has lost its interference to unequal warmth or to its speed: unless its conductance is given it conducts like a gap from there on, and it may creep, which this run does not follow.");
    }
}
