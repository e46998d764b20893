//! Named results of one test with acceleration.

use crate::identify::estimate::TestEstimate;
use identify::Measurement;
use identify::loss::Loss;
use identify::slip::Established;
use outcome::list::origins;
use outcome::list::results;
use physics::rolling::RollingSet;
use physics::spin_up_energy::SpinUpEnergy;
use statistics::uncertain::Uncertain;

/// What is known of a test before it is read.
pub(crate) struct OfTest {
    /// Balls and cage.
    pub set: RollingSet<f64>,
    /// Whether the channel of the cage is given.
    pub cage: bool,
}

results! {
    /// The results of one test.
    pub(crate) fn table(of: &OfTest, run: &TestEstimate) {
        "test_*.name": text "" headline, TEST, "name of the test" => run.name.as_str();
        "test_*.radial_load": number "N", TEST, "weight on the bearing" => run.measurement.load;
        "test_*.engagement_time": number "s", ENGAGED, "when the quick change of speed begins" => {
            run.measurement.engagement.ok_or_else(|| "no quick change was found".to_string())
        };
        "test_*.peak_acceleration": number "rad/s^2" headline, TEST, "largest acceleration" => run.peak_acceleration.value;
        "test_*.peak_acceleration_deviation": number "rad/s^2", TEST, "its standard deviation" => run.peak_acceleration.deviation;
        "test_*.excess_torque_settled": number "N m" headline, EXCESS, "t_O - M shortly after the engagement" => run.settled_excess().map(|u| u.value);
        "test_*.excess_torque_settled_deviation": number "N m" headline, EXCESS, "its standard deviation" => run.settled_excess().map(|u| u.deviation);
        "test_*.excess_torque_at_end": number "N m" headline, EXCESS, "t_O - M at the end of the hold" => run.excess_at_end().map(|u| u.value);
        "test_*.excess_torque_at_end_deviation": number "N m" headline, EXCESS, "its standard deviation" => run.excess_at_end().map(|u| u.deviation);
        "test_*.torque_to_roll_within_3_5_s": number "N m", ROLLING_UP, "net torque that would bring balls and cage to rolling in 3.5 s" => {
            let rolling = SpinUpEnergy { set: of.set, final_speed: run.measurement.fastest(), outer_moment_work: 0.0 };
            rolling.final_angular_momentum() / FALL
        };
        "test_*.dissipated_energy": number "J" headline, ENERGY, "energy dissipated in the spin-up, as well as it is known" => run.best_energy().map(|u| u.value);
        "test_*.dissipated_energy_deviation": number "J" headline, ENERGY, "its standard deviation" => run.best_energy().map(|u| u.deviation);
        "test_*.dissipated_energy_printed": number "J", ENERGY, "by (21) as printed" => run.energy().map(|d| d.printed.value);
        "test_*.dissipated_energy_printed_deviation": number "J", ENERGY, "its standard deviation" => run.energy().map(|d| d.printed.deviation);
        "test_*.dissipated_energy_corrected": number "J", ENERGY, "by (21) corrected" => run.energy().map(|d| d.corrected.value);
        "test_*.dissipated_energy_corrected_deviation": number "J", ENERGY, "its standard deviation" => run.energy().map(|d| d.corrected.deviation);
        "test_*.dissipated_energy_exact": number "J", ENERGY, "with the cage signal" => run.exact_energy().map(|u| u.value);
        "test_*.dissipated_energy_exact_deviation": number "J", ENERGY, "its standard deviation" => run.exact_energy().map(|u| u.deviation);
        "test_*.dissipated_energy_without_cage": number "J", ENERGY, "without a cage signal" => run.energy().map(|d| d.without_cage.value);
        "test_*.dissipated_energy_without_cage_deviation": number "J", ENERGY, "its standard deviation" => run.energy().map(|d| d.without_cage.deviation);
        "test_*.dissipation_until": number "s", UNTIL, "time after the engagement at which the final speed is reached" => {
            run.dissipation.as_ref().map(|d| d.window.1 - run.measurement.begin()).map_err(Clone::clone)
        };
        "test_*.printed_form": text "", ENERGY, "verdict on (21) as printed" => run.energy().map(|found| found.printed_verdict());
        "test_*.slip_probability": number "1" headline, SLIP, "largest probability of a slip of the cage" in slips "cage slipped" when of.cage => run.slip_probability();
        "test_*.rolling_established_at": number "s", ROLLS, "time after the engagement from which on the cage rolls" when of.cage => run.rolling_established();
        "test_*.skid_probability": number "1", SKID, "probability that balls skid" in slips "balls skidded, if M holds" => run.skid_probability();
    }
}

/// Net torque that would bring balls and cage to rolling speed within the time in which the source paper's torque fell, s.
const FALL: f64 = 3.5;

impl TestEstimate {
    fn excess(
        &self,
        part: fn(&Loss, &Measurement) -> Option<Uncertain>,
        lacking: &str,
    ) -> Result<Uncertain, String> {
        let loss = self.loss.as_ref().map_err(Clone::clone)?;
        part(loss, &self.measurement).ok_or_else(|| lacking.to_string())
    }

    fn settled_excess(&self) -> Result<Uncertain, String> {
        let lacking = "no engagement was found, or t_O - M is not known 0.2 to 0.4 s after it";
        self.excess(Loss::settled_excess, lacking)
    }

    fn excess_at_end(&self) -> Result<Uncertain, String> {
        let lacking =
            "the test does not hold its full speed long enough, or t_O - M is not known there";
        self.excess(Loss::excess_at_end, lacking)
    }

    fn exact_energy(&self) -> Result<Uncertain, String> {
        let none = || "without a cage signal over the whole spin-up".to_string();
        self.energy()?.exact.ok_or_else(none)
    }

    fn slip_probability(&self) -> Result<f64, String> {
        let slip = self.slip.as_ref().map_err(Clone::clone)?;
        let none = || "the band of the slip is wider than its limit throughout".to_string();
        slip.slipped.ok_or_else(none)
    }

    fn rolling_established(&self) -> Result<f64, String> {
        match self.slip.as_ref().map_err(Clone::clone)?.established {
            Established::At { time, .. } => Ok(time - self.measurement.begin()),
            Established::Throughout => {
                Err("as far as the signal shows, the cage never slipped".to_string())
            }
            Established::Never => Err("not before the record ends".to_string()),
        }
    }

    fn skid_probability(&self) -> Result<f64, String> {
        if let Some(why) = self.withheld() {
            let low = "a torque that is low for another reason looks like skid";
            return Err(format!("{why}, and {low}"));
        }
        if self.rolls {
            let stated = "the balls roll throughout, as it is stated or the tests support";
            return Err(stated.to_string());
        }
        let skid = self.skid.as_ref().map_err(Clone::clone)?;
        let none = || "torque and cage do not show the spin of the balls".to_string();
        skid.skidded.ok_or_else(none)
    }
}

origins! {
    TEST: law "as measured by the signals of the test",
        source "Bierman 1977 (filter and smoother), crates/measure/src/speed/mod.rs",
        valid "see auxbear signals of its file";
    ENGAGED: law "when the quick change of the speed begins, in the time of the file; other times of a test count from here",
        source "Bierman 1977 (filter and smoother), crates/measure/src/speed/mod.rs",
        valid "see auxbear signals of its file";
    EXCESS: law "mean of t_O - M, 0.2 to 0.4 s after the engagement, or over the last 0.5 s at full speed",
        source "crates/identify/src/loss/mod.rs",
        valid "the deviation is that of one value: errors close in time are shared";
    ROLLING_UP: law "L0/3.5 s, L0 = R² Ω0 [N m_b (½ + 0.3 s) + ½ m_c (1+s)]: net torque that brings balls and cage to rolling speed in the time in which the source paper's torque fell",
        source "crates/physics/src/spin_up_energy.rs",
        valid "compare it with the fall of the torque: balls that still speed up would need traction and drag to agree this closely";
    ENERGY: law "D = ∫t_O Ω dt + ∫Ω dL - Δ(KE + U) with a cage signal; (21) as printed, corrected; without a cage signal the corrected form where rolling is stated or the verdict, else the middle of a range: of balls that roll at the end, or of any slip where the verdict does not exclude it",
        source "the source paper, (21), and its correction; crates/identify/src/dissipation.rs",
        valid "from the engagement until the final speed is reached";
    UNTIL: law "when 99 % of the largest speed is reached, counted from the engagement",
        source "crates/identify/src/dissipation.rs",
        valid "engagement_time is in the time of the file";
    ROLLS: law "from when on |S| above 1 % stays less likely than not, counted from the engagement",
        source "Harris 2001, section 8 (kinematics), crates/identify/src/slip.rs",
        valid "needs a cage signal; engagement_time is in the time of the file";
    SLIP: law "S = 1 - 2(1+s)ω_c/Ω; the largest probability of |S| above 1 % at any time",
        source "Harris 2001, section 8 (kinematics), crates/identify/src/slip.rs",
        valid "needs a cage signal";
    SKID: law "spin of the balls from (4), (5), (7) with F ≥ 0",
        source "the source paper, (4), (5) and (7); crates/identify/src/skid.rs",
        valid "shortly after the engagement, as long as the torque shows it, with the lubricant in the state of the slow tests: a grease that starts low looks like skid";
}
