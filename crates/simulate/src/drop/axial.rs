//! A rotor that moves along its axis: its axial magnet, which loses its power alone or with all radial ones.

use crate::drop::Drop;
use crate::drop::magnets_in_time::happens;
use model::rotor::AxialConstants;
use model::system::machine::{AtSpeed, Event};
use scenario::{Happens, MagnetEvent, When};

/// Constants of its motion along the axis; none where no bearing is one in space.
pub(super) fn motion(drop: &Drop, mass: f64) -> Option<AxialConstants<f64>> {
    let mut bearings = (drop.auxiliary_bearings.iter()).filter_map(|part| part.bearing.as_ref());
    bearings.find(|bearing| bearing.spatial.is_some())?;
    let gravity = drop.gravity.axial;
    let magnet = drop.levitation.axial;
    let [stiffness, damping] = magnet.unwrap_or([0.0; 2]);
    Some(AxialConstants {
        gravity,
        stiffness,
        damping,
        carried: magnet.map_or(0.0, |_| -mass * gravity),
    })
}

/// Whether no event takes the power of an axial magnet.
pub(super) fn holds_throughout(drop: &Drop) -> bool {
    let (mut known, mut at_speeds) = (Vec::new(), Vec::new());
    switches(drop, &mut known, &mut at_speeds);
    let is_lost = |event: &Event| matches!(event, Event::Thrust(share) if *share == 0.0);
    let at_speeds = at_speeds.iter().flat_map(|own| &own.then);
    let mut all = known.iter().chain(at_speeds);
    drop.levitation.axial.is_some() && !all.any(|(_, event)| is_lost(event))
}

/// What the axial magnet does when it or all radial ones lose their power, and when they have it again.
pub(super) fn switches(drop: &Drop, known: &mut Vec<(f64, Event)>, at_speeds: &mut Vec<AtSpeed>) {
    let (Some(_), Some(shaft)) = (drop.levitation.axial, &drop.shaft) else {
        return;
    };
    let Some(levitation) = &shaft.model.levitation else {
        // supports let go at the start
        return known.push((0.0, Event::Thrust(0.0)));
    };
    let all = levitation.levitation.actuators().len();
    for own in &shaft.events {
        let share = match &own.what {
            Happens::Magnets(axes, MagnetEvent::Lost(_)) if axes.len() == all => 0.0,
            Happens::AxialMagnetLost => 0.0,
            Happens::Magnets(_, MagnetEvent::Relevitated(_)) => 1.0,
            _ => continue,
        };
        match own.when {
            When::At(time) if time <= 0.0 => known.push((0.0, Event::Thrust(share))),
            when => happens(when, Event::Thrust(share), known, at_speeds),
        }
    }
}
