//! Every named result of a drop with its law, source and valid range.

use crate::bearing::quantities::balls;
use crate::bearing::races::{Life, life, lubricant_factor};
use crate::bearing::run::BearingRun;
use crate::bearing::severity::{
    BLOWS, HEAT_INDEX, HOT_RACE, RISE as RACE_RISE, blows, inner_race_rise,
};
use crate::bearing::warm::{self, RINGS};
use crate::drop::context::{Context, Setup, touched};
use crate::drop::{base, events, magnets, mount_results, shaft_results, surfaces};
use crate::following::Following;
use crate::static_safety::{no_safety, safety_under};
use catalogue::geometry::digits;
use model::auxiliary_bearing::probe::AXIAL_FORCE;
use model::spatial::race::RaceGroove;
use model::spatial::record::SpatialRecord;
use model::spatial::{PreloadSpring, SpatialBearing};
use model::system::energy::{Content, Flows};
use model::system::machine::record::BearingRecord;
use outcome::Quantity;
use outcome::list::results;
use outcome::list::{List, not_given, origins, relative};
use physics::life::load_of_damage;
use scenario::{AuxiliaryBearing, Bearing, axial_share};
use std::f64::consts::PI;

const EQUATIONS: &str =
    "equations of motion, crates/model/src/system/machine/rate.rs and crates/model/src/bearing/";
const CONTACT: &str = "Hunt and Crossley 1975, crates/model/src/contact.rs";
const EVENT: &str = "root on dense output of the time integration, crates/solve/src/watch.rs";
const LEDGER: &str = "energy ledger, crates/model/src/system/machine/ledger.rs";

/// Names the results of one member, without a run those of any: those of each auxiliary bearing under its name, then those of
/// the machine.
pub(crate) fn name(setup: Setup, run: Option<&Context>) -> Vec<Quantity> {
    let mut list = List::default();
    for (k, part) in setup.parts().enumerate() {
        list.of_part(part, |list| {
            of_bearing(list, (setup, k), run.map(|run| Landed::of(run, k)).as_ref());
        });
    }
    shaft_results::name(&mut list, setup, run);
    release(&mut list, &setup, run);
    magnets::name(&mut list, setup, run);
    events::name(&mut list, setup, run);
    energies(&mut list, &setup, run);
    list.ended_at(run.map(|run| run.finished.ending.time))
}

/// Names the results of one auxiliary bearing.
fn of_bearing(list: &mut List, (setup, k): (Setup, usize), run: Option<&Landed>) {
    let given = setup.given(k);
    let constants = &setup.machine.constants.bearings[k];
    contacts(list, &(), run);
    if let Some(own) = setup.balls(k) {
        spin_up(list, &(), run);
        balls(list, &own, run.map(|run| &run.balls));
        load(list, own.given, run);
        if let Some(space) = constants.spatial() {
            in_space(list, space, run);
        }
        let life_of = run.and_then(|run| run.life(own.given));
        let rating = own.given.dynamic_load_rating;
        life(list, &(rating, setup.heated(k)), life_of.as_ref());
    }
    mount_force(list, &(), run);
    if constants.mount_parts.any() {
        let peaks = run.and_then(|run| run.record.mount_parts.as_ref());
        mount_results::name(list, &given.mount.parts, peaks);
    }
    motion(list, given, run);
    if let Some(bearing) = &given.bearing {
        warming(list, bearing, run);
    }
    rubbing(list, given, run);
    surfaces::name(list, given, run.map(|run| run.record));
    if let Some(heated) = setup.heated(k) {
        warm::name(
            list,
            &heated,
            run.and_then(|run| run.context.followed(k)).as_ref(),
        );
    }
}

/// An auxiliary bearing after a run.
struct Landed<'a> {
    context: &'a Context<'a>,
    k: usize,
    record: &'a BearingRecord,
    balls: BearingRun<'a>,
}

impl<'a> Landed<'a> {
    fn of(context: &'a Context, k: usize) -> Self {
        Landed {
            context,
            k,
            record: context.record(k),
            balls: context.bearing(k),
        }
    }
    /// An instant from the release on, s.
    fn after(&self, time: f64) -> f64 {
        time - self.context.counted_from()
    }
    /// When a speed is reached after the release, s.
    fn reached(&self, time: Option<f64>, what: &str) -> Result<f64, String> {
        let never = || match self.context.release_time() {
            Some(_) => {
                let time = digits(1e3 * self.after(self.context.finished.ending.time));
                format!("{what} was not reached in {time} ms after the release")
            }
            None => magnets::kept(),
        };
        time.map(|time| self.after(time)).ok_or_else(never)
    }
    /// What of a speed is per turn, of a rotor that turned once.
    fn per_turn(&self, way: f64, turned: f64) -> Result<f64, String> {
        let contact = &self.context.setup.given(self.k).contact;
        match self.record.travel.turned >= 2.0 * PI {
            true => Ok(way / (contact.radial_air_clearance * turned)),
            false => Err("the rotor did not turn once".to_string()),
        }
    }
    /// Cubic mean of the load on the bearing over the turns of its inner race, N.
    fn mean_load(&self) -> Result<f64, String> {
        let mean = (self.record.cubed_load_turns / self.record.turns).cbrt();
        let still = || "the inner race did not turn".to_string();
        (self.record.turns > 0.0).then_some(mean).ok_or_else(still)
    }
    fn life(&self, given: &Bearing) -> Option<Life> {
        let speed = 2.0 * PI * self.record.turns / self.context.finished.ending.time;
        let followed = self.context.followed(self.k);
        let factor = |share: f64| {
            let radial = self.mean_load()?;
            let load = match (&given.spatial, given.dynamic_load_rating) {
                // its thrust counts as much
                (Some(_), Some(rating)) => load_of_damage(rating, share, self.record.turns),
                _ => radial,
            };
            let unknown = || "its temperatures are not followed".to_string();
            lubricant_factor(&followed.ok_or_else(unknown)?, load, speed)
        };
        Life::of(given, self.record.races.as_ref()?, factor)
    }
    /// What was seen of a bearing in space.
    fn space<T>(&self, of: impl Fn(&SpatialRecord) -> Option<T>) -> Result<T, String> {
        let none = || "rotor and face never touched in this run".to_string();
        self.record.spatial.as_deref().and_then(of).ok_or_else(none)
    }
    fn landed_first(&self) -> Result<&'static str, String> {
        let bore = self.record.contacts.first().map(|contact| contact.start);
        let face = self.space(|own| own.first_axial_contact).ok();
        match (bore, face) {
            (None, None) => Err("the rotor touched neither bore nor face in this run".to_string()),
            (Some(bore), Some(face)) if bore < face => Ok("bore"),
            (Some(_), None) => Ok("bore"),
            _ => Ok("face"),
        }
    }
    /// Force on the faces in the last row, N.
    fn axial_force_at_end(&self) -> Result<f64, String> {
        let at = self.context.setup.machine.layout().bearings[self.k];
        let row = self.context.finished.record.rows().next_back();
        row.map(|row| row.probe[at.probe(AXIAL_FORCE)])
            .ok_or_else(|| "this run kept no rows".to_string())
    }
    fn angle(&self, race: usize) -> Result<f64, String> {
        let seen = |own: &SpatialRecord| Some(own.largest_angles[race].value);
        let angle = self.space(seen).unwrap_or_default();
        let none = || "no ball was pressed".to_string();
        (angle > 0.0).then_some(angle).ok_or_else(none)
    }
    fn unloaded(&self) -> Vec<f64> {
        let times = self.record.spatial.iter().flat_map(|own| &own.unloaded);
        times
            .map(|time| time.map_or(f64::NAN, |time| self.after(time)))
            .collect()
    }
    /// What is watched of a preload spring.
    fn spring(&self, of: impl Fn(&PreloadSpring<f64>, &SpatialRecord) -> f64) -> f64 {
        let part = &self.context.setup.machine.constants.bearings[self.k];
        let spring = part.spatial().and_then(|own| own.spring);
        let both = spring.zip(self.record.spatial.as_deref());
        both.map_or(f64::NAN, |(spring, own)| of(&spring, own))
    }
    fn run_over(&self) -> Result<f64, String> {
        let own = self.record.spatial.as_deref().and_then(|own| own.run_over);
        let none = || "no contact reached the shoulder of its groove".to_string();
        own.map(|own| self.after(own.time)).ok_or_else(none)
    }
    fn whirl_direction(&self) -> &'static str {
        let [forward, backward] = self.whirl();
        match (backward < 1.0, forward < 1.0) {
            (false, _) => "backward",
            (true, false) => "forward",
            (true, true) => "none",
        }
    }
    /// The most turns of whirl in succession with the spin and against it.
    fn whirl(&self) -> [f64; 2] {
        let speed = self.context.setup.machine.constants.speed;
        self.record.whirl_turns.about(speed)
    }
    /// Those in one sense, counter-clockwise positive.
    fn whirl_turns(&self) -> f64 {
        let [left, right] = self.record.whirl_turns.most;
        if left < right { -right } else { left }
    }
}

results! {
    fn contacts(setup: &(), run: &Landed) {
        "time_to_first_contact": instant "s" headline, FIRST_CONTACT, "first contact after the release" in instants_after_release "first contact" => {
            touched(run.record.contacts.first().map(|first| run.after(first.start)))
        };
        "first_impact_force": contact "N" headline, CONTACT_FORCE, "largest normal force of the first contact" => {
            touched(run.record.contacts.first().map(|first| first.peak_force))
        };
        "peak_contact_force": contact "N" headline, CONTACT_FORCE, "largest normal force between rotor and inner race" in tile "Peak contact force" => {
            touched(run.record.peak_contact_force().map(|peak| peak.value))
        };
        "contact_count": number "" headline, CONTACT_COUNT, "number of contacts" in note "Peak contact force: contacts" => run.record.contacts.len() as f64;
        "contact_start_times": list "s", CONTACT_STARTS, "begins of the contacts after the release" => {
            run.record.contacts.iter().map(|contact| run.after(contact.start)).collect::<Vec<_>>()
        };
        "slips_at_end": number "", SLIPS, "1 where the rotor touches it at the end, or may soon again, and its inner race or bushing is slower than 95 % of the rotor; else 0" => f64::from(u8::from(run.context.slips_at_end(run.k).is_some()));
    }
    fn spin_up(setup: &(), run: &Landed) {
        "inner_race_time_to_50_percent": instant "s", RISE, "time of the inner race to half of the release speed" in instants_after_release "race 50 %" in note "Inner race at 95 % speed: half of it at" => {
            run.reached(run.record.inner_race_time_to_50_percent(), "half of the rotor's release speed")
        };
        "inner_race_time_to_95_percent": instant "s" headline, RISE, "time of the inner race to 95 % of the release speed" in instants_after_release "race 95 %" in tile "Inner race at 95 % speed" => {
            run.reached(run.record.inner_race_time_to_95_percent(), "95 % of the rotor's release speed")
        };
        "cage_time_to_95_percent_of_rolling": instant "s", RISE, "time of the cage to 95 % of its rolling speed" in instants_after_release "cage 95 % of rolling" => {
            run.reached(run.record.cage_time_to_95_percent(), "95 % of the rolling cage speed of the rotor's release speed")
        };
        "inner_race_final_speed": number "rad/s", SPEED, "speed of the inner race at the end" => {
            run.balls.end[run.context.setup.machine.layout().bearings[run.k].inner.spin()]
        };
        "cage_final_speed": number "rad/s", SPEED, "speed of the cage at the end" => run.context.setup.machine.cage_speed(run.k, run.balls.end);
    }
    fn load(given: &Bearing, run: &Landed) {
        "peak_bearing_load": number "N", LOAD, "largest radial load on the bearing" => run.record.largest_bearing_load.value;
        "static_safety": number "1", SAFETY, "static load rating over equivalent peak load", unless no_safety(given) => {
            safety_under(run.record.largest_bearing_load.value, given)
        };
        "inner_race_turns": number "", TURNS, "turns of the inner race" => run.record.turns;
        "cubic_mean_load": number "N", MEAN_LOAD, "cubic mean load over these turns" => run.mean_load();
    }
    /// What a bearing in space does along its axis.
    fn in_space(setup: &SpatialBearing, run: &Landed) {
        "landed_first": text "", AXIAL, "where the rotor landed first: in the bore or on a face" in note "Peak contact force: landed first in/on the" when setup.stops() => {
            run.landed_first()
        };
        "time_to_first_axial_contact": instant "s", AXIAL, "first contact of a shoulder and a face after the release" in instants_after_release "axial contact" when setup.stops() => {
            run.space(|own| own.first_axial_contact.map(|time| run.after(time)))
        };
        "peak_axial_force": contact "N" headline, AXIAL, "largest force between shoulder and face" in tile "Peak axial force" when setup.stops() => {
            run.space(|own| own.first_axial_contact.map(|_| own.axial_force.value))
        };
        "max_mount_axial_displacement": number "m", MOUNT_ALONG, "largest displacement of the outer ring along the axis" in note "Peak axial force: outer ring moves by" when setup.stops() => {
            run.record.spatial.as_ref().map_or(f64::NAN, |own| own.outer_place.value)
        };
        "axial_force_at_end": number "N", AXIAL, "force between shoulder and face at the end" in note "Peak axial force: at the end [N]" when setup.stops() => run.axial_force_at_end();
        "face_temperature_rise": contact "K", FACE_HEAT, "largest mean rise of shoulder and face" in note "Peak axial force: mean rise of the face [K]" when setup.stops() => {
            run.space(|own| own.first_axial_contact.map(|_| own.face_heat.rise.value))
        };
        "face_temperature_time": instant "s", FACE_HEAT, "instant of this rise" when setup.stops() => run.space(|own| own.first_axial_contact.map(|_| own.face_heat.rise.time));
        "peak_inner_contact_angle": number "rad", ANGLES, "largest contact angle at the inner race" in axial "inner race" => run.angle(0);
        "peak_outer_contact_angle": number "rad", ANGLES, "largest contact angle at the outer race" in axial "outer race" => run.angle(1);
        "row_unloaded_times": list "s", UNLOADED, "when each row first carried nothing, by its place along the shaft; NaN where it always did" when setup.rows.len() > 1 => {
            run.unloaded()
        };
        "smallest_preload_spring_force": number "N", SPRING, "smallest force of the preload spring" when setup.spring.is_some() => {
            run.spring(|spring, own| spring.preload - own.spring_forces[1].value)
        };
        "largest_preload_spring_force": number "N", SPRING, "largest force of the preload spring" when setup.spring.is_some() => {
            run.spring(|_, own| own.spring_forces[0].value)
        };
        "shoulder_run_over_time": instant "s", RUN_OVER, "when a contact ellipse first reached over the shoulder of its groove" in instants_after_release "over shoulder", unless {
            not_given("bearing.shoulder_height", setup.groove_ends)
        } => run.run_over();
        "groove_end_angles": list "rad", GROOVE_ENDS, "contact angles at which the grooves of the inner and the outer race end" in space "groove ends", unless {
            not_given("bearing.shoulder_height", setup.groove_ends)
        } => setup.groove_ends.map_or(Vec::new(), Vec::from);
        "contact_ellipse_half_angles": list "rad", ELLIPSES, "half of the angle that the contact ellipses at the inner and the outer race cover in their grooves under 1 N" in space "ellipses" => {
            let ball = &setup.rows[0].ball;
            let half = |race: &RaceGroove<f64>| race.half_axis / race.stiffness.cbrt() / ball.radius;
            vec![half(&ball.inner), half(&ball.outer)]
        };
    }
    fn mount_force(setup: &(), run: &Landed) {
        "peak_mount_force": number "N", MOUNT_FORCE, "largest force of the mount on the housing" => run.record.largest_mount_force.value;
    }
    /// Displacements, whirl and what friction took.
    fn motion(given: &AuxiliaryBearing, run: &Landed) {
        "max_rotor_race_displacement": number "m", DISPLACEMENT, "largest distance of the rotor from the inner race's centre" => {
            run.record.rotor_race_displacement.value
        };
        "max_rotor_displacement": number "m", ROTOR_DISPLACEMENT, "largest displacement of the rotor across its axis in contact" in tile "Largest rotor displacement" => {
            touched(run.record.contacts.first().map(|_| run.record.rotor_displacement.value))
        };
        "max_mount_displacement": number "m", MOUNT_DISPLACEMENT, "largest displacement of the outer race across its axis" => run.record.mount_displacement.value;
        "whirl_direction": text "" headline, WHIRL, "direction of whirl" => run.whirl_direction();
        "whirl_turns": number "", WHIRL, "most turns of whirl about the inner race in succession in one sense, counter-clockwise positive" => run.whirl_turns();
        "backward_whirl_turns": number "", WHIRL, "most turns of whirl in succession against the spin" => run.whirl()[1];
        "travel_index": number "1", TRAVEL, "longest way of the rotor in one turn over that of full whirl" => run.per_turn(run.record.travel.longest, 2.0 * PI);
        "speed_index": number "1", SPEED_INDEX, "mean speed of the rotor's centre over that of full whirl" => {
            run.per_turn(run.record.travel.way, run.record.travel.turned)
        };
        "rotor_race_friction_energy": number "J", ENERGY, "friction heat of rotor and inner race" => run.balls.heat("rotor_race_friction");
        "ball_slip_energy": number "J", ENERGY, "sliding heat of the balls at both races" => run.balls.ball_slip();
        "blow_index": number "1", BLOWS, "sum of all blows beyond the load at rest" => {
            blows(run.record.contacts.iter().map(|contact| contact.peak_force), run.context.setup.drop().weight(run.k))
        };
    }
    /// What half of the heats at its surfaces warms the inner race by.
    fn warming(given: &Bearing, run: &Landed) {
        "inner_race_rise_without_cooling": number "K", RACE_RISE, "rise of the inner race without cooling" => inner_race_rise(&run.balls, given);
        "heat_index": number "1", HEAT_INDEX, "this rise over that of common rings" in worst "inner race too hot" => inner_race_rise(&run.balls, given).map(|rise| rise / HOT_RACE);
    }
    fn rubbing(given: &AuxiliaryBearing, run: &Landed) {
        "rotor_race_friction_energy_per_area": number "J/m^2", PER_AREA, "friction heat over the landing surface", unless {
            surfaces::no_width(given)
        } => run.balls.heat("rotor_race_friction") / (PI * given.contact.bore_diameter * given.contact.width.unwrap_or(f64::NAN));
    }
    fn release(setup: &Setup, run: &Context) {
        "release_time": number "s", RELEASE, "instant of the release" in instants "release" => run.release_time().ok_or_else(magnets::kept);
        "axial_gravity_share": number "1", AXIAL_SHARE, "share of the weight along the shaft" => axial_share(run.setup.drop().gravity.acceleration);
        "base_largest_acceleration": number "m/s^2", BASE, "largest acceleration of the base" in machine_tile "Largest acceleration of the base" when setup.machine.constants.base.is_some() => {
            base::largest(&run.setup.machine.constants, run.finished.ending.time)
        };
    }
    fn energies(setup: &Setup, run: &Context) {
        "rotor_final_speed": number "rad/s", SPEED, "speed of the rotor at the end" in document "final speed" => run.finished.ending.state[run.setup.machine.layout().rotor.spin()];
        "dissipated_energy": number "J" headline, ENERGY, "heat of all losses" => run.heat();
        "dissipated_energy_of_all_bearings": number "J", ALL_BEARINGS, "heat of all losses in all planes" => run.planes() * run.heat();
        "work_of_warm_rings": number "J", RINGS, "work of rings that close on loaded balls" in sources "work of warm rings" when Following::of(setup.drop()).is_some() => {
            run.finished.work_of_rings() / run.planes()
        };
        "work_of_sources": number "J", BALANCE, "work of sources" => run.change(|(_, flows)| flows.work);
        "kinetic_energy_change": number "J", BALANCE, "change of the kinetic energy" => run.change(|(content, _)| content.translation + content.spin);
        "potential_energy_change": number "J", BALANCE, "change of the potential energy" => run.change(|(content, _)| content.potential);
        "energy_balance_residual": number "J", BALANCE, "residual of the energy ledger" => run.finished.whole_balance().energy_residual() / run.planes();
        "energy_residual": number "1" headline, RESIDUAL, "residual of the energy ledger over what is turned over" in machine_tile "Energy residual" in bound "AB1006" in document "residual" => residuals(run).0;
        "angular_momentum_residual": number "1", RESIDUAL, "residual of the angular momentum over that of the inner races" => residuals(run).1;
    }
}

impl Context<'_> {
    /// Equal planes of a rotor whose bearings have no names: energies are those of one.
    fn planes(&self) -> f64 {
        f64::from(self.setup.drop().rotor.planes)
    }
    /// Heat of all losses, J.
    fn heat(&self) -> f64 {
        self.setup.machine.flows(&self.finished.ending.state).heat / self.planes()
    }
    /// Change of an energy over the run, J.
    fn change(&self, of: fn((Content, Flows)) -> f64) -> f64 {
        let balance = self.finished.whole_balance();
        (of(balance.end) - of(balance.start)) / self.planes()
    }
}

/// What is turned over must exceed this share of the kinetic energy at the start to be compared with.
const ROUNDING: f64 = 1e-12;

/// Largest residuals of the run, relative: (energy, angular momentum).
pub(crate) fn residuals(context: &Context) -> (Result<f64, String>, Result<f64, String>) {
    let machine = context.setup.machine;
    let record = &context.finished.record;
    let start = &context.finished.start;
    let balance = context.finished.whole_balance();
    let scale = (balance.heat())
        .max(balance.end.1.work_size)
        .max(record.largest_translation);
    // rounding of the spins is not compared with nothing
    let stored = machine.content(start);
    let scale = if scale > ROUNDING * (stored.translation + stored.spin) {
        scale
    } else {
        0.0
    };
    let constants = &machine.constants;
    let inertia: f64 = (constants.bearings.iter())
        .map(|part| part.planes * part.inner_race.inertia)
        .sum();
    let at = machine.layout().rotor.spin();
    let ended = context.finished.ending.state[at];
    // a rotor that runs up has its speed at the end
    let spin = constants.speed.abs().max(ended.abs());
    // bearings that are not touched settle: what they turn over is no measure of a machine
    let parts = 0..constants.bearings.len();
    let scale = match parts.clone().all(|k| context.record(k).contacts.is_empty()) {
        true => scale.max(0.5 * inertia * spin * spin),
        false => scale,
    };
    let momentum_scale = (inertia * spin).max(balance.angular_impulse().abs());
    (
        relative(balance.energy_residual(), scale),
        relative(balance.angular_momentum_residual(), momentum_scale),
    )
}

origins! {
    BASE: law "largest |b̈(t)| within the run, at its points and a thousand instants of each half-sine",
        source "the file; crates/model/src/base.rs",
        valid "a base that translates in the plane of the bearings: it neither rocks nor turns";
    TURNS: law "∫|ω_i| dt/2π",
        source "definition",
        valid "from the start of the run to the end of what is computed ball by ball";
    MEAN_LOAD: law "(∫W³ dn/n)^(1/3), W the load on the bearing, n the turns of the inner race",
        source "ISO 281; crates/model/src/system/machine/bearing_record.rs",
        valid "as inner_race_turns; balls that preload each other are not counted in W";
    TRAVEL: law "longest way of the rotor's centre against the inner race in one turn of the rotor, over 2π c0",
        source "definition; crates/model/src/system/machine/travel.rs",
        valid "0 of a rotor that lies still, 1 of a whirl around the whole gap once a turn; 64 points a turn, over the whole run";
    SPEED_INDEX: law "mean speed of the rotor's centre against the inner race over c0 times the mean spin",
        source "definition; crates/model/src/system/machine/travel.rs",
        valid "as travel_index";
    RELEASE: law "first instant, from the start of the run, at which a magnet, an axis or all power is lost",
        source "levitation.power_lost_at; 0 where the run begins with the release",
        valid "column time and instants in messages count from the start of the run; results of contacts, spin-up and whirl from here";
    AXIAL_SHARE: law "sqrt(1 - (g/g0)^2), g = gravity.acceleration across the shaft, g0 = 9.80665 m/s^2",
        source "geometry; 0 from 9.76 m/s^2 on, the weakest gravity on Earth",
        valid "shafts that stand; motion along the shaft is not in the run";
    FIRST_CONTACT: law "gap d = |C - c_i| - c0 closes, after the release; gravity and the levitated orbit's speed then",
        source EVENT,
        valid "negative of a rotor that touches before the release; from the start of the run where nothing is released";
    CONTACT_STARTS: law "begins of contact after the release, d = 0 rising",
        source EVENT,
        valid "as time_to_first_contact; late contacts may be chaotic: repeat the run";
    CONTACT_FORCE: law "N = max(0, k dⁿ(1 + a ḋ)), largest of each contact",
        source CONTACT,
        valid "stiffness, exponent and damping of the landing surfaces as given; late impacts may be chaotic: repeat the run";
    SLIPS: law "1 where |ω_i| < 0.95 |Ω| and the rotor is in contact, has been apart for no longer than 50 ms or the longest pause between contacts so far, or has met a face; else 0",
        source EVENT,
        valid "bounces through a clearance, of hundredths of a second";
    CONTACT_COUNT: law "begins of contact, d = 0 rising; one that lasts to the end is included",
        source EVENT,
        valid "late contacts may be chaotic: repeat the run";
    RISE: law "first instant after the release at which the speed reaches the level; levels refer to the rotor's speed at release",
        source EQUATIONS,
        valid "constant friction coefficient between rotor and race; friction of the bearing only as its fidelity has it";
    SPEED: law "angular momentum of each body about its axis",
        source EQUATIONS,
        valid "coasting is as true as the friction of the bearing: bearing.moment, ball by ball also slip and oil in the inlets";
    DISPLACEMENT: law "largest |C - c_i|, where its rate changes sign",
        source EVENT,
        valid "below a tenth of the bearing's size";
    MOUNT_DISPLACEMENT: law "largest |c_o|, at the steps and, near the record, on dense output between them",
        source EQUATIONS,
        valid "below a tenth of the bearing's size";
    MOUNT_ALONG: law "largest displacement of the outer ring along its axis from where it is at rest, at the ends of steps",
        source "crates/model/src/system/machine/bearing_record.rs",
        valid "mount.axial_stiffness, linear at any displacement";
    ROTOR_DISPLACEMENT: law "largest distance of the rotor centre from the line of levitation, while in contact, at the steps",
        source EVENT,
        valid "compare it with seals and other air gaps at this plane";
    WHIRL: law "turns of the rotor about the inner race while outside half its clearance, most in succession; below one turn: none",
        source "definition",
        valid "a rotor that bends may whirl backward where a rigid one does not: system = \"machine\"";
    ENERGY: law "time integral of friction force times sliding speed, and of every other loss",
        source LEDGER,
        valid "heat of what is simulated: of rotor.planes that of one, of a bearing with planes that of one row under its name and that of all in dissipated_energy; nothing is cooled or warmed by it";
    BALANCE: law "work_of_sources = kinetic_energy_change + potential_energy_change + dissipated_energy + energy_balance_residual",
        source LEDGER,
        valid "rotor and all bearings with all their rows, over the whole run; sources below zero take energy out; of rotor.planes that of one";
    ALL_BEARINGS: law "dissipated_energy times rotor.planes: of bearings with names it is the sum of all their rows already",
        source LEDGER,
        valid "heat of bearings, mounts and landing surfaces; nothing is cooled or warmed by it";
    LOAD: law "largest size of the sum of all ball forces on the outer race, at the steps and near the largest ball load between them",
        source EQUATIONS,
        valid "radial plane; a preload that all balls share evenly cancels in the sum";
    SAFETY: law "s0 = C0/P0, P0 = max(F_r, X0 F_r + Y0 F_a) with F_r = peak_bearing_load and F_a = bearing.axial_preload",
        source "ISO 76 (from memory), crates/physics/src/static_load.rs",
        valid "assumes that a short peak dents as a load at rest, and the usual share of the most loaded ball: peak_hertz_pressure says what that ball carries";
    AXIAL: law "shoulder plane against nodes of a face, N = max(0, k d(1 + a ḋ)) each, friction μ N against the slip; largest at the ends of the steps",
        source "derived, book/src/theory/spatial.md, crates/model/src/spatial/face.rs",
        valid "rigid shoulder, plane face; stiffness and damping as given";
    FACE_HEAT: law "both surfaces of one temperature: layers of shoulder and ring under the friction power of the faces, over the whole annulus",
        source "slab under constant flux, crates/model/src/spatial/face_heat.rs; book/src/theory/spatial.md",
        valid "a mean over contact.face_width all round: an edge that touches first, under tilt or with burrs, is far hotter; both faces as one; no heat \
            beyond the layers";
    ANGLES: law "|α| of the loaded contacts, sin α = n·a of that ring; largest of eight looks a turn, more where loads change",
        source "derived, book/src/theory/spatial.md, crates/model/src/spatial/record.rs",
        valid "torus-shaped grooves without end: see shoulder_run_over_time";
    UNLOADED: law "first look at which no ball of a row is pressed by its inner race, of a row that had one",
        source "crates/model/src/spatial/record.rs",
        valid "eight looks a turn, more where loads change";
    SPRING: law "(F0 + k c)₊ of its compression c beyond that of the preload F0, and the force of the stop where it is solid, at the ends of the steps",
        source "crates/model/src/spatial/spring.rs; book/src/theory/spatial.md",
        valid "a massless linear spring; outer rings that slide without friction";
    RUN_OVER: law "|α| + a_H/r > acos(1 - h/r_g): the ellipse reaches the shoulder",
        source "derived, book/src/theory/spatial.md, crates/model/src/spatial/record.rs",
        valid "errs to the safe side by 4 %; from there on the stress at the edge is not known, and the contact is computed as if its groove went on";
    ELLIPSES: law "a/r_b under 1 N: half of the long axis over the ball's radius; it grows with Q^(1/3)",
        source "Hertz, book/src/theory/spatial.md",
        valid "as the elliptic contact; of the first row";
    GROOVE_ENDS: law "acos(1 - h/r_g) of each race",
        source "derived, book/src/theory/spatial.md",
        valid "middle of a contact at the edge of the shoulder; its ellipse is cut off before";
    MOUNT_FORCE: law "largest |F| of spring, damper and all other parts, at the steps and near the largest ball load between them; the weight of the bearing is in it",
        source mount_results::SOURCE,
        valid "force of the outer race on its housing";
    PER_AREA: law "rotor_race_friction_energy/(π D b), bore D, contact.width b",
        source LEDGER,
        valid "mean over the bore, of both surfaces together: without whirl one place of it takes most";
    RESIDUAL: law "what the ledger misses at the end, over max(heat, works, largest kinetic energy of the rotor's centre); \
          momentum over that of the inner races at the speed of the rotor, at the release or the end, or over the impulse from outside where that is more; of bearings that are never touched energy \
          over that of their inner races at this speed",
        source LEDGER,
        valid "a measure of the integration error; it falls with run.tolerance";
}
