//! Named results of a vibration, of slow runs and of the converter, with law, source and valid range.

use crate::signals::estimate::Estimate;
use crate::signals::request::{Request, median, sampled};
use identify::steady_curve::SteadyCurve;
use outcome::list::results;
use outcome::list::{List, origins};
use recording::unit::unit_in_si;

/// Names the results; what was not asked for has none.
pub(crate) fn name(list: &mut List, asked: &Request, found: Option<&Estimate>) {
    if sampled(asked).any(|series| series.converter.is_some()) {
        converter(list, asked, found);
    }
    if let Some(series) = &asked.vibration {
        orders(list, asked, found);
        if let Some(amplitudes) = list.quantities.last_mut() {
            amplitudes.unit = unit_in_si(&series.unit).0;
        }
        spectrograms(list, asked, found);
    }
    if asked.signals.steady.is_some() {
        steady(list, asked, found);
    }
}

results! {
    fn converter(asked: &Request, run: &Estimate) {
        "converter_clipped_values": number "", CONVERTER, "values at the limits" in repairs "values at the limits of the converter, all its channels" => run.converted.iter().map(|one| one.clipped as f64).sum::<f64>();
        "converter_rounding_share_of_noise": number "1", CONVERTER, "largest share of the noise that is rounding" in repairs "rounding of the converter, largest share of a channel's noise" => {
            run.converted.iter().map(|one| one.rounding_share).fold(0.0, f64::max)
        };
    }

    /// The amplitudes are in the unit of the channel.
    fn orders(asked: &Request, run: &Estimate) {
        "vibration_orders": list "1", ORDERS, "orders of the shaft" in orders "order" => run.orders(|o| o.order);
        "vibration_order_amplitudes": list "1", ORDERS, "median amplitude of each order" in orders "amplitude" => run.orders(|o| median(&o.amplitude()));
    }

    fn spectrograms(asked: &Request, run: &Estimate) {
        "vibration_spectrogram_times": list "s", SPECTROGRAM, "times of the spectrogram" => run.vibration(|v| &v.over_time).map(|p| p.time.clone());
        "vibration_spectrogram_frequencies": list "Hz", SPECTROGRAM, "its frequencies" => run.vibration(|v| &v.over_time).map(|p| p.upright.clone());
        "vibration_spectrogram_levels": list "1", SPECTROGRAM, "its levels" => run.vibration(|v| &v.over_time).map(|p| p.levels.clone());
        "vibration_order_spectrogram_times": list "s", SPECTROGRAM, "times of that over order" => run.vibration(|v| &v.over_order).map(|p| p.time.clone());
        "vibration_order_spectrogram_orders": list "1", SPECTROGRAM, "its orders" => run.vibration(|v| &v.over_order).map(|p| p.upright.clone());
        "vibration_order_spectrogram_levels": list "1", SPECTROGRAM, "its levels" => run.vibration(|v| &v.over_order).map(|p| p.levels.clone());
    }

    fn steady(asked: &Request, run: &Estimate) {
        "steady_inertia": number "kg m^2", INERTIA, "moment of inertia of what coasts" in slow_inertia "I" => run.steady(|p| &p.inertia).map(|i| i.value);
        "steady_inertia_deviation": number "kg m^2", INERTIA, "its standard deviation" => run.steady(|p| &p.inertia).map(|i| i.deviation);
        "steady_speeds": list "rad/s", STEADY, "speeds of the curves" in slow_speeds "speed" => run.slow().map(|p| p.speed.clone());
        "steady_direct_torques": list "N m", STEADY, "torque by the sensor as the speed falls" in steady_torques "by the sensor, speed falling" => run.steady(|p| &p.direct).map(|c| c.torque.clone());
        "steady_direct_deviations": list "N m", STEADY, "its standard deviations" => run.steady(|p| &p.direct).map(SteadyCurve::whole_deviation);
        "steady_inertial_torques": list "N m", STEADY, "torque by inertia and deceleration" in steady_torques "−I dΩ/dt, less windage where it is given" => run.steady(|p| &p.inertial).map(|c| c.torque.clone());
        "steady_inertial_deviations": list "N m", STEADY, "its standard deviations" => run.steady(|p| &p.inertial).map(SteadyCurve::whole_deviation);
        "steady_up_torques": list "N m", STEADY, "torque by the sensor as the speed rises" in steady_torques "by the sensor, speed rising" => run.steady(|p| &p.up).map(|c| c.torque.clone());
        "steady_up_deviations": list "N m", STEADY, "its standard deviations" => run.steady(|p| &p.up).map(SteadyCurve::whole_deviation);
        "steady_windage_torques": list "N m", WINDAGE, "torque of the windage" in steady_torques "windage" when asked.has_windage() => run.windage(|w, speed| w.at(speed));
        "steady_windage_deviations": list "N m", WINDAGE, "its standard deviations" when asked.has_windage() => {
            run.windage(|w, speed| w.covariance(speed, speed).map(f64::sqrt))
        };
        "steady_direct_less_inertial": number "N m", COMPARED, "mean of the torque by the sensor less that by inertia" in differences "by the sensor less −I dΩ/dt" => {
            run.steady(|p| &p.direct_less_inertial).map(|d| d.mean.value)
        };
        "steady_direct_less_inertial_deviation": number "N m", COMPARED, "its standard deviation" => {
            run.steady(|p| &p.direct_less_inertial).map(|d| d.mean.deviation)
        };
        "steady_direct_less_inertial_chance": number "1", COMPARED, "chance of this where both are equal" => {
            run.steady(|p| &p.direct_less_inertial).map(|d| d.chance)
        };
        "steady_up_less_down": number "N m", COMPARED, "mean of the torque up less that down" in differences "rising less falling speed" => run.steady(|p| &p.up_less_down).map(|d| d.mean.value);
        "steady_up_less_down_deviation": number "N m", COMPARED, "its standard deviation" => run.steady(|p| &p.up_less_down).map(|d| d.mean.deviation);
        "steady_up_less_down_chance": number "1", COMPARED, "chance of this where both are equal" => run.steady(|p| &p.up_less_down).map(|d| d.chance);
    }
}

impl Request {
    fn has_windage(&self) -> bool {
        (self.signals.steady.as_ref()).is_some_and(|wish| wish.windage.is_some())
    }
}

origins! {
    CONVERTER: law "values at the limits of the range; rounding noise step/√12 over the noise of the channel, largest of all channels",
        source "Bennett 1948 (rounding), crates/measure/src/converter.rs; noise: median of fourth differences",
        valid "equal steps of the converter; a signal that is smooth from value to value but for its noise";
    ORDERS: law "signal = mean + Σ (a cos kθ + b sin kθ) + rest, a and b smooth; amplitude √(a² + b²), peak; median over time",
        source "Vold and Leuridan 1993, crates/measure/src/order",
        valid "amplitudes that change slower than the bandwidth; orders above twice the bandwidth";
    SPECTROGRAM: law "amplitude of Hann segments, in whole dB below the largest (20 log10 of the ratio), column after column; -80 and less is -80",
        source "Welch 1967, windows after Harris 1978, crates/measure/src/spectrum",
        valid "a picture: the largest of neighbouring lines and segments stands for them";
    INERTIA: law "as given; m g a T²/4π² - m a² (pendulum); m g d² T²/16π² l (two strings); ΔM/(α₁ - α₀) (known torque)",
        source "crates/measure/src/inertia.rs",
        valid "small swings, light damping; everything that coasts takes part";
    STEADY: law "direct: smooth curve through torque over speed; inertial: -I dΩ/dt of a smooth curve through the speed of whole turns, or as an instrument shows it, less the windage where it is known; deviation: standard, of the inertia included",
        source "Eilers and Marx 1996, crates/identify/src/steady_curve; bands in crates/identify/tests/steady_curve.rs",
        valid "one passage over the speeds; inertial: all that brakes what coasts, other bearings and air included";
    WINDAGE: law "what brakes the shaft without the bearing, a + b Ω + c Ω² as given or -I dΩ/dt of a run without it; it is taken out of the inertial torque",
        source "crates/identify/src/coasting.rs",
        valid "the same shaft, gas and other bearings in both runs";
    COMPARED: law "mean difference over the common speeds; chance of so large a difference between equal curves",
        source "Satterthwaite 1946, crates/identify/src/steady_curve/compare.rs",
        valid "independent errors of the two curves";
}
