//! Named results of a vibration, of slow runs and of the converter, with law, source and valid range.

use crate::analyse::signals::asked::Asked;
use crate::analyse::signals::found::Found;
use crate::analyse::signals::vibration;
use crate::result::list::{List, Origin};
use crate::result::outcome::Value;
use identify::steady_curve::{Difference, SteadyCurve};

/// Names the results; what was not asked for has none.
pub(crate) fn name(list: &mut List, asked: &Asked, found: &Found) {
    if !found.converted.is_empty() {
        converter(list, found);
    }
    if asked.vibration.is_some() {
        vibration(list, found);
    }
    if asked.signals.steady.is_some() {
        steady(list, asked, found);
    }
}

fn listed(values: Result<Vec<f64>, String>) -> Value {
    match values {
        Ok(values) => Value::List(values),
        Err(why) => Value::None { why },
    }
}

fn converter(list: &mut List, found: &Found) {
    let all = || found.converted.iter();
    let clipped = all().map(|one| one.clipped as f64).sum();
    list.number("converter_clipped_values", "", Ok(clipped), &CONVERTER);
    let share = all().map(|one| one.rounding_share).fold(0.0, f64::max);
    list.number(
        "converter_rounding_share_of_noise",
        "1",
        Ok(share),
        &CONVERTER,
    );
}

fn vibration(list: &mut List, found: &Found) {
    let part = found
        .vibration
        .as_ref()
        .ok_or_else(|| found.why("vibration"));
    let orders = part.as_ref().map_err(|why| why.clone()).and_then(|part| {
        part.orders
            .as_ref()
            .ok_or_else(|| "signals.vibration.orders is not given".to_string())
    });
    let unit = part.as_ref().map_or("1", |part| part.unit);
    let of = |value: &dyn Fn(&measure::order::Order) -> f64| {
        orders
            .as_ref()
            .map(|found| found.orders.iter().map(value).collect::<Vec<f64>>())
            .map_err(|why| why.clone())
    };
    list.push("vibration_orders", "1", listed(of(&|o| o.order)), &ORDERS);
    let middle = |mut values: Vec<f64>| {
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    };
    list.push(
        "vibration_order_amplitudes",
        unit,
        listed(of(&|o| middle(o.amplitude()))),
        &ORDERS,
    );
    type Side = fn(&vibration::Found) -> &Result<vibration::Picture, String>;
    let sides: [(&str, &str, &'static str, Side); 2] = [
        ("vibration_spectrogram", "frequencies", "Hz", |p| {
            &p.over_time
        }),
        ("vibration_order_spectrogram", "orders", "1", |p| {
            &p.over_order
        }),
    ];
    for (name, upright, upright_unit, side) in sides {
        let picture = part
            .as_ref()
            .map_err(|why| why.clone())
            .and_then(|part| side(part).as_ref().map_err(|why| why.clone()));
        let of = |value: fn(&vibration::Picture) -> &Vec<f64>| {
            listed(
                picture
                    .as_ref()
                    .map(|p| value(p).clone())
                    .map_err(|why| why.clone()),
            )
        };
        list.push(&format!("{name}_times"), "s", of(|p| &p.time), &SPECTROGRAM);
        list.push(
            &format!("{name}_{upright}"),
            upright_unit,
            of(|p| &p.upright),
            &SPECTROGRAM,
        );
        list.push(
            &format!("{name}_levels"),
            "1",
            of(|p| &p.levels),
            &SPECTROGRAM,
        );
    }
}

fn steady(list: &mut List, asked: &Asked, found: &Found) {
    let part = || found.steady.as_ref().ok_or_else(|| found.why("steady"));
    let inertia = || part().and_then(|part| part.inertia.clone());
    list.number(
        "steady_inertia",
        "kg m^2",
        inertia().map(|i| i.value),
        &INERTIA,
    );
    list.number(
        "steady_inertia_deviation",
        "kg m^2",
        inertia().map(|i| i.deviation),
        &INERTIA,
    );
    list.push(
        "steady_speeds",
        "rad/s",
        listed(part().map(|p| p.speed.clone())),
        &STEADY,
    );
    type Curve = fn(&crate::analyse::signals::steady::Found) -> &Result<SteadyCurve, String>;
    let curves: [(&str, Curve); 3] = [
        ("direct", |p| &p.direct),
        ("inertial", |p| &p.inertial),
        ("up", |p| &p.up),
    ];
    for (name, curve) in curves {
        let curve = || part().and_then(|p| curve(p).as_ref().map_err(|why| why.clone()));
        let (torque, deviation) = (
            curve().map(|c| c.torque.clone()),
            curve().map(SteadyCurve::whole_deviation),
        );
        list.push(
            &format!("steady_{name}_torques"),
            "N m",
            listed(torque),
            &STEADY,
        );
        list.push(
            &format!("steady_{name}_deviations"),
            "N m",
            listed(deviation),
            &STEADY,
        );
    }
    let windage = || part().and_then(|part| Ok((part, part.windage.clone()?)));
    let torques = windage().map(|(part, windage)| {
        let at = |speed: &f64| windage.at(*speed).unwrap_or(f64::NAN);
        part.speed.iter().map(at).collect()
    });
    let deviations = windage().map(|(part, windage)| {
        let at = |speed: &f64| {
            windage
                .covariance(*speed, *speed)
                .map_or(f64::NAN, f64::sqrt)
        };
        part.speed.iter().map(at).collect()
    });
    let asked_for = (asked.signals.steady.as_ref()).is_some_and(|wish| wish.windage.is_some());
    if asked_for {
        list.push("steady_windage_torques", "N m", listed(torques), &WINDAGE);
        list.push(
            "steady_windage_deviations",
            "N m",
            listed(deviations),
            &WINDAGE,
        );
    }
    type Pair = fn(&crate::analyse::signals::steady::Found) -> &Result<Difference, String>;
    let pairs: [(&str, Pair); 2] = [
        ("direct_less_inertial", |p| &p.direct_less_inertial),
        ("up_less_down", |p| &p.up_less_down),
    ];
    for (name, pair) in pairs {
        let pair = || part().and_then(|p| pair(p).as_ref().map_err(|why| why.clone()));
        list.number(
            &format!("steady_{name}"),
            "N m",
            pair().map(|d| d.mean.value),
            &COMPARED,
        );
        list.number(
            &format!("steady_{name}_deviation"),
            "N m",
            pair().map(|d| d.mean.deviation),
            &COMPARED,
        );
        list.number(
            &format!("steady_{name}_chance"),
            "1",
            pair().map(|d| d.chance),
            &COMPARED,
        );
    }
}

const CONVERTER: Origin = Origin {
    law: "values at the limits of the range; rounding noise step/√12 over the noise of the channel, largest of all channels",
    source: "Bennett 1948 (rounding), crates/measure/src/converter.rs; noise: median of fourth differences",
    valid: "equal steps of the converter; a signal that is smooth from value to value but for its noise",
};
const ORDERS: Origin = Origin {
    law: "signal = mean + Σ (a cos kθ + b sin kθ) + rest, a and b smooth; amplitude √(a² + b²), peak; median over time",
    source: "Vold and Leuridan 1993, crates/measure/src/order",
    valid: "amplitudes that change slower than the bandwidth; orders above twice the bandwidth",
};
const SPECTROGRAM: Origin = Origin {
    law: "amplitude of Hann segments, in whole dB below the largest (20 log10 of the ratio), column after column; -80 and less is -80",
    source: "Welch 1967, windows after Harris 1978, crates/measure/src/spectrum",
    valid: "a picture: the largest of neighbouring lines and segments stands for them",
};
const INERTIA: Origin = Origin {
    law: "as given; m g a T²/4π² - m a² (pendulum); m g d² T²/16π² l (two strings); ΔM/(α₁ - α₀) (known torque)",
    source: "crates/measure/src/inertia.rs",
    valid: "small swings, light damping; everything that coasts takes part",
};
const STEADY: Origin = Origin {
    law: "direct: smooth curve through torque over speed; inertial: -I dΩ/dt of a smooth curve through the speed of whole turns, or as an instrument shows it, less the windage where it is known; deviation: standard, of the inertia included",
    source: "Eilers and Marx 1996, crates/identify/src/steady_curve; bands in crates/identify/tests/steady_curve.rs",
    valid: "one passage over the speeds; inertial: all that brakes what coasts, other bearings and air included",
};
const WINDAGE: Origin = Origin {
    law: "what brakes the shaft without the bearing, a + b Ω + c Ω² as given or -I dΩ/dt of a run without it; it is taken out of the inertial torque",
    source: "crates/identify/src/coasting.rs",
    valid: "the same shaft, gas and other bearings in both runs",
};
const COMPARED: Origin = Origin {
    law: "mean difference over the common speeds; chance of so large a difference between equal curves",
    source: "Satterthwaite 1946, crates/identify/src/steady_curve/compare.rs",
    valid: "independent errors of the two curves",
};
