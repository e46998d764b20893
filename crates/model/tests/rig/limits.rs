//! What is refused, and what cannot be found.

use super::bench::{SPEED, clutch, concentric, housing, rolls};
use model::bearing::BearingConstants;
use model::system::machine::RotorMachine;
use model::system::rig::{Action, Engagement, Program, RampError, Refusal, Start, engagement_ramp};
use model::table::Table;

fn spin_up(largest: f64) -> Program {
    Program::spin_up(SPEED, 0.0, Engagement { rate: 1.0, largest }, true)
}

fn refusal(change: impl Fn(&mut model::system::rig::RigConstants)) -> Option<Refusal> {
    let mut c = concentric(BearingConstants::Rolling(rolls()), spin_up(5.0));
    change(&mut c);
    RotorMachine::on_rig(c).err()
}

#[test]
fn constants_without_meaning_are_refused() {
    assert_eq!(refusal(|_| {}), None);
    for refused in [
        refusal(|c| c.race.inertia = 0.0),
        refusal(|c| clutch(c).flywheel.inertia = f64::NAN),
        refusal(|c| c.target_speed = 0.0),
        refusal(|c| housing(c).heat.capacity = -1.0),
        refusal(|c| {
            housing(c).centre_held = false;
            housing(c).mass = 0.0;
        }),
    ] {
        assert!(
            matches!(refused, Some(Refusal::NotPositive(_))),
            "{refused:?}"
        );
    }
    let negative = refusal(|c| c.load = Table::constant(-1.0));
    assert_eq!(negative, Some(Refusal::NegativeLoad));
    let varies = Table::through(vec![(0.0, 1.0), (1.0, 2.0)]).expect("rises");
    let changes = refusal(|c| c.load = varies.clone());
    assert_eq!(changes, Some(Refusal::LoadChanges));
    let direction = refusal(|c| c.load_direction.x = 1.0);
    assert_eq!(direction, Some(Refusal::Direction));
    let order = refusal(|c| {
        clutch(c).program.actions = vec![(1.0, Action::MotorOff), (0.5, Action::Disengage)];
    });
    assert_eq!(order, Some(Refusal::Order(1)));
    let action = refusal(|c| {
        clutch(c).program.actions = vec![(
            0.0,
            Action::Engage(Engagement {
                rate: -1.0,
                largest: 1.0,
            }),
        )];
    });
    assert_eq!(action, Some(Refusal::Action(0)));
}

#[test]
fn an_acceleration_beyond_the_clutch_is_out_of_reach() {
    let rig = |program: Program| concentric(BearingConstants::Rolling(rolls()), program);
    // 0.1 N m on 1e-4 kg m²: less than 1000 rad/s²
    match engagement_ramp(&rig(spin_up(0.1)), 7200.0, SPEED) {
        Err(RampError::OutOfReach { nearest }) => {
            assert!((500.0..1000.0).contains(&nearest), "{nearest}");
        }
        other => panic!("{other:?}"),
    }
    let still = Program {
        start: Start::REST,
        actions: Vec::new(),
    };
    let nothing = engagement_ramp(&rig(still), 7200.0, SPEED);
    assert_eq!(nothing, Err(RampError::NoEngagement));
    let weak = engagement_ramp(&rig(spin_up(1e-3)), 7200.0, SPEED);
    assert_eq!(weak, Err(RampError::NeverLocks));
    // released after a second: a ramp of torque needs a peak of twice the mean, and of more where drag delays the start; the
    // flywheel gives a little of its speed
    let mut short = spin_up(5.0);
    short.actions.push((1.0, Action::Disengage));
    for wanted in [1.0, 50.0] {
        match engagement_ramp(&rig(short.clone()), wanted, SPEED) {
            Err(RampError::TooSlow { smallest }) => {
                assert!((1.8 * SPEED..6.0 * SPEED).contains(&smallest), "{smallest}");
            }
            other => panic!("{wanted}: {other:?}"),
        }
    }
    // what is out of reach does not change with how far out it is
    let most = |wanted: f64| match engagement_ramp(&rig(spin_up(0.1)), wanted, SPEED) {
        Err(RampError::OutOfReach { nearest }) => nearest,
        other => panic!("{wanted}: {other:?}"),
    };
    // rates that are tried are e apart
    assert!((most(1e4) / most(1e6) - 1.0).abs() < 0.05);
    let backwards = engagement_ramp(&rig(spin_up(5.0)), 0.0, SPEED);
    assert_eq!(backwards, Err(RampError::NotPositive));
}
