//! Warnings of a drop, its magnets, its flexible rotor and its coast-down.

/// Share of the first bending frequency from which on a rotor bends noticeably.
pub(crate) const BENDING_SHARE: f64 = 0.7;

problem::warnings! {
    /// Of a drop.
    pub enum DropWarning {
        Bends { bending: "rad/s", side: words, speed: "rad/s" } "AB1001" Invalid, each
            ("The first free-free bending mode ({bending:.0} rad/s) {side} the release speed ({speed:.0} rad/s): this rigid rotor is indicative only.");
        ContactDamping { damping: "1" } "AB1004" Invalid, unperturbed
            ("The damping of rotor and race reaches a·ḋ = {damping:.2}: the Hunt-Crossley law is meant for values well below 1.");
        AboveLoadRating { force: "N", rating: "N" } "AB1005" Invalid, each
            ("The contact force of {force:.0} N exceeds the static load rating of {rating:.0} N: Palmgren's moment is outside its range.");
        Planes { planes: "" } "AB1007" Note
            ("{planes} identical planes are computed as one by symmetry: mass, polar inertia and torques of the rotor are shared equally, forces and heats are those of one plane. Conical motion is not described.");
        Dragged "AB1010" Note
            ("Balls or cage are dragged to the ground (bearing.drag): that reproduces reference cases, it is no friction moment of a real bearing.");
        DragIgnored "AB1010" Note ("bearing.drag belongs to the planar fidelity and is ignored here.");
        ManyContacts { contacts: "" } "AB1011" Note, unperturbed
            ("{contacts} contacts: the first impacts, spin-up times and energies are reproducible, the late ones are chaotic. Repeat the run to see the spread: --repeat 16 samples the unbalance angle too, unless repeat.unbalance_angle = \"as given\".");
        BackwardWhirl { turns: "1" } "AB1014" Destroys, each by "whirl_turns"
            ("Backward whirl: the rotor runs {turns:.0} turns round the bore against its spin. Contact forces of this kind destroy bearings and shafts.");
        BackwardWhirlInCoastDown { time: "s", when: words } "AB1014" Destroys, coast_down by "whirl_turns"
            ("Backward whirl during the coast-down, {when}: the rotor runs round the bore against its spin. Contact forces of this kind destroy bearings and shafts.");
        StaticLoad { load: "N", factor: "1", rating: "N" } "AB1029" Invalid
            ("The static radial load of {load:.0} N is {factor:.1} times the static load rating of {rating:.0} N: permanent dents must be expected, and the laws of contact and friction are outside their range.");
        OneMotion { bearings: "" } "AB1090" Invalid
            ("The rotor does not tilt: all {bearings} auxiliary bearings see one motion, wherever they stand on the shaft. Forces of bearings that differ, or of a rotor whose mass is not midway, are indicative only.");
        AxialMagnetHolds "AB2417" Uncertain
            ("The axial magnet keeps its power throughout: no event takes it (\"axial magnet lost\", or \"power lost\"). Shoulders and faces meet only what that magnet lets through, and nothing of this run shows an axial landing.");
        HardStop { gap: "m", time: "s", force: "N", peak_time: "s" } "AB1097" Invalid, each
            ("The mount hits its hard stop: the outer race closes the gap of {:.0} µm at {:.2} ms, and the stop carries up to {force:.0} N at {:.2} ms. The resilient part protects nothing then; a larger gap, a stiffer mount or more damping keeps them apart.", 1e6 * gap, 1e3 * time, 1e3 * peak_time);
        BendingUnknown { speed: "rad/s" } "AB1126" Note
            ("Whether the rotor bends was not checked: rotor.first_bending_frequency is not given. A rotor whose first free-free bending mode lies below {:.0} rad/s is not rigid at this speed.", speed / BENDING_SHARE);
        HotRace { rise: "K" } "AB2300" Destroys, each
            ("Without cooling the inner race warms by {rise:.0} K: clearance, lubricant, friction and hardness change with that, and this run does not follow them.");
        HotContact { rise: "K", time: "s" } "AB2301" Destroys, each by "contact_temperature_rise"
            ("Where rotor and race rub, the patch warms by {rise:.0} K ({:.2} ms): steel softens and transforms there, the surfaces may smear or seize, and the friction coefficient of this run no longer holds.", 1e3 * time);
        HotContactInCoastDown { part: text, on: words, time: "s", rise: "K" } "AB2301" Destroys, coast_down
            ("During the coast-down, after {time:.1} s, the patch where rotor and race rub{on} is {rise:.0} K warmer than at the start: steel softens and transforms there, the surfaces may smear or seize, and the friction coefficient of this run no longer holds.");
        HotSpot { stay: "s" } "AB2302" Invalid, each
            ("One place of the rotor stays in the contact for {:.0} ms: a hot spot, which bends the shaft and adds to its unbalance. This run spreads its heat over the rotor's track and bends nothing.", 1e3 * stay);
        ForwardWhirlInCoastDown { time: "s", when: words } "AB2302" Invalid, coast_down
            ("Forward whirl during the coast-down, {when}: unbalance throws the rotor round the bore with its spin. One place of it stays in the contact: a hot spot, which bends the shaft and adds to its unbalance. This run bends nothing.");
        RollingDoesNotLast { time: "s", speed: "rad/s", last_time: "s", last_speed: "rad/s", force: "N" } "AB2317" Uncertain, coast_down
            ("Rolling does not last: unbalance or a load lifts the rotor again, from {time:.1} s and {speed:.0} rad/s on, the last time until {last_time:.1} s and {last_speed:.0} rad/s, with contact forces up to {force:.0} N. Whether such a motion becomes a whirl is chance: repeat the run (--repeat 8).");
        SlidesInCoastDown { time: "s", duration: "s", when: words, slowest: words, rubs: words, shared: words } "AB2318" Uncertain, coast_down
            ("{when} the rotor slides on its races{slowest}: friction makes {rubs}. It is in coast_down.load_dependent_heat{shared}.");
        WindowsScatter { deviation: "1", windows: "" } "AB2319" Uncertain, coast_down
            ("Mean power loss uncertain by {:.0} % (1 sigma, the worst of {windows} ball-by-ball intervals). Coast-down time and heat have at least this uncertainty there.", 100.0 * deviation);
        MomentIsHeld { time: "s", speed: "rad/s", moment: "N m", held: "s", power: "1", longer: "s" } "AB2325" Uncertain, coast_down
            ("From {time:.1} s and {speed:.0} rad/s on nothing is followed ball by ball: the moment of the bearings there, {moment:.2e} N m, is held to the standstill, for {held:.0} s. No law knows the moment of bearings in space at low speed. Until there it changed with the power {power:.2} of the speed; going on so, the rotor would turn for {longer:.0} s longer.");
        HardestInCoastDown { part: text, on: words, time: "s", speed: "rad/s", force: "N", before: "N", end: "s", load_share: "1" } "AB2323" Invalid, coast_down
            ("The contact force{on} reaches {force:.3e} N during the coast-down ({time:.1} s, {speed:.0} rad/s); the first {end:.3} s had {before:.3e} N. A ball takes {:.0} % of the load that dents a race there; cage forces of this run are those of the first {end:.3} s alone.", 100.0 * load_share);
        EndsBeforeLanding { time: "s" } "AB2324" Invalid, coast_down
            ("run.duration ends after {time:.4} s, before the rotor has landed on every bearing: its impacts are in none of these results. Give run.duration more.");
        EndsBeforeSpinUp { time: "s", late: "s" } "AB2324" Invalid, coast_down
            ("run.duration ends after {time:.4} s, while inner races still come to their speed: for {late:.2} s more. Temperatures, heat and wear of that time are among the results of the coast-down. Give run.duration that much more for forces and slip of every instant.");
        Bushing { friction: "1" } "AB2330" Uncertain, each
            ("The rotor rubs on a bushing with a friction coefficient of {friction}: no race comes to speed and ends that, so friction drives backward whirl for as long as the rotor turns. Whether a blow starts it depends on friction, damping and the release: vary them (--repeat). What warming and wear do to friction and clearance is not followed.");
        StillRising { force: "N", time: "s" } "AB2423" Uncertain, each
            ("The force of rotor and bearing grows until {:.1} ms (largest {force:.0} N), late in this run or so shortly after their first contact that no bounce was seen: it may rise further, and what follows from it too. A longer run.duration shows it.", 1e3 * time);
        NotLanded { place: words } "AB2424" Uncertain, each
            ("The rotor does not come to {place} before the run ends, and no magnet holds it: what it does there is not in this run. A longer run.duration shows it.");
        StillSlips { share: "1" } "AB2426" Uncertain, each
            ("The run ends while the rotor slips on its race, which has come to {:.0} % of its speed: friction may still drive whirl, and forces and displacements grow. A longer run.duration shows it.", (100.0 * share).floor());
        LayerIsWarm { since: "s", through: "s" } "AB2331" Uncertain, each
            ("The rotor's surface is hottest {since:.1} s after the first contact, and without heat.network = \"on\" its layer gives no heat to the metal behind it: from {through:.1} s on its rise, contact_temperature_rise and the share of heat that the race takes are too high. A bushing has no network: a deeper contact.surface.rotor_layer is right for longer.");
    }
}

problem::warnings! {
    /// Of the flexible rotor of a drop and its magnets.
    pub enum ShaftWarning {
        Rub { part: text, displacement: "m", time: "s", clearance: "m" } "AB2030" Destroys, each by "clearance_positions"
            ("At {part} the rotor moves by up to {:.0} µm ({:.2} ms), beyond the clearance of {:.0} µm: it touches what stands there, and this contact is not computed.", 1e6 * displacement, 1e3 * time, 1e6 * clearance);
        Strikes { displacement: "m", time: "s", clearance: "m" } "AB2425" Destroys, each by "rotor_axial_clearance"
            ("The rotor moves by up to {:.0} µm along its axis ({:.2} ms), beyond rotor.axial_clearance of {:.0} µm: it strikes what stands there, and this contact is not computed.", 1e6 * displacement, 1e3 * time, 1e6 * clearance);
        FewModes { cutoff: "rad/s", needed: "rad/s" } "AB2031" Invalid
            ("rotor.cutoff = {cutoff:.0} rad/s keeps fewer modes than impacts bend: forces may be wrong by a factor. Ten times the speed or the first bending mode, {needed:.0} rad/s, is the least; compare with twice that.");
        Resonance { speed: "rad/s", held: words, frequency: "rad/s", amplification: "1", size: words } "AB2032" Invalid, each
            ("The speed at the release ({speed:.0} rad/s) is near a mode of the rotor {held} ({frequency:.0} rad/s, {size}): it may turn with large orbits before it falls, and small changes of speed or unbalance change the drop much.");
        ThickShaft { shaft: "m", bore: "m" } "AB2033" Invalid
            ("The shaft is {:.1} mm thick where the bearing stands, its bore (contact.bore_diameter) {:.1} mm: one of both is wrong, and friction acts at the radius of the bore.", 1e3 * shaft, 1e3 * bore);
        CurrentLimit { channel: text, others: words, limit: words, share: "1", time: "s" } "AB2034" Uncertain, each
            ("{channel} reaches the limit of its coil ({limit} A, {:.1} % of the time with power, first at {:.2} ms){others}: what the linear analysis says of stability and response does not hold there.", 100.0 * share, 1e3 * time);
        DrivenFromOutside { commands: text } "AB2037" Uncertain
            ("The machine was driven from outside, as a co-simulation unit: {commands} came from its caller. Its file alone gives other results.");
        TouchesWithPower { time: "s" } "AB2035" [TOUCHES_WITH_POWER] Invalid, each
            ("The rotor touches the bearing at {:.2} ms, while its magnets have power: their controllers do not hold it here, and a rub may change what they do.", 1e3 * time);
        VoltageLimit { channel: text, limit: words, share: "1", time: "s" } "AB2036" Uncertain, each
            ("{channel} reaches the largest of its amplifier ({limit}{:.1} % of the time with power, first at {:.2} ms): its current comes later than the controller wants it, and what the linear analysis says of stability and response does not hold there.", 100.0 * share, 1e3 * time);
        NotHeldAgain { time: "s", last: "s", ends: words, end: "s", hold: "s", first: words } "AB2082" Destroys, each
            ("The rotor is levitated again at {time:.4} s and not held: it was in contact or far from the middle until {last:.4} s, and {hold} s without are asked before {ends} at {end:.4} s; {first}. Magnets that push a rotor into its bearings load them for as long as they have power.");
        EventNever { name: text, why: words } "AB2083" Uncertain
            ("The event {name} never happens: {why}.");
        CutOff { what: words, until: "s", end: "s" } "AB2085" Uncertain, each
            ("{what} lasts until {until:.4} s, and the run ends at {end:.4} s: what it does after that is not in these results.");
        NoLossOfPower "AB2084" Note
            ("The magnets keep their power: with events of magnets, sensors or controllers levitation.power_lost_at has no default.");
        AgainstSpin { supports: text } "AB2041" Uncertain
            ("The rotor turns backward, and {supports} keep the signs of their xy and yx coefficients, which of a real seal change with the spin: as given they drive whirl against it. Change their signs, or let the rotor turn forward.");
        StiffContact { contact: "N/m", mount: "N/m", cutoff: "rad/s" } "AB2081" Uncertain
            ("contact {contact:.2e} N/m at 10 µm of penetration and mount {mount:.2e} N/m are stiffer than those ({:.2e}, {:.2e} N/m) up to which rotor.cutoff = {} rad/s was compared with more modes: first impacts may be several per cent wrong. Compare with twice and four times the cutoff.", compared(cutoff).contact, compared(cutoff).mount, units::number_text(compared(cutoff).cutoff));
    }
}

/// Up to which parts a cutoff was compared with more modes.
pub(crate) struct Compared {
    /// Largest stiffness of a contact at 10 µm of penetration, N/m.
    pub contact: f64,
    /// Largest stiffness of a mount, N/m.
    pub mount: f64,
    /// The cutoff, rad/s.
    pub cutoff: f64,
}

/// That of design accuracy with all modes, first impacts within 0.7 % at these, 7.5 % at four and five times as stiff (a rotor that bends at 3126 rad/s).
const AT_DESIGN: Compared = Compared {
    contact: 6.19e8,
    mount: 4e8,
    cutoff: scenario::CUTOFFS[1],
};
/// That of screening with that of design on the three shipped machines that have no controller or that run up: within 1.9 %.
const AT_SCREENING: Compared = Compared {
    contact: 3.1e8,
    mount: 2e7,
    cutoff: scenario::CUTOFFS[0],
};

/// What stands for a cutoff, rad/s.
pub(crate) fn compared(cutoff: f64) -> Compared {
    match cutoff < AT_DESIGN.cutoff {
        true => AT_SCREENING,
        false => AT_DESIGN,
    }
}
