//! The equations of motion of a machine.

use super::layout::{ROTOR, ROTOR_CHANNELS, ROTOR_SOURCES};
use super::{Machines, Mode};
use crate::auxiliary_bearing::{AtNode, Outlet, write_body};
use crate::contact::ContactReaction;
use crate::motion::Wrench;
use crate::rotor::{GeometricCentre, RotorMotion};
use number::{Mask, Real, Vec2};

/// Motion of the rotor in a state.
#[inline(always)]
pub fn rotor_motion<R: Real>(state: &[R]) -> RotorMotion<R> {
    let rotor = &state[ROTOR..ROTOR + ROTOR_CHANNELS];
    RotorMotion {
        position: Vec2::new(rotor[0], rotor[1]),
        velocity: Vec2::new(rotor[2], rotor[3]),
        angle: rotor[4],
        spin: rotor[5],
    }
}

impl<R: Real> Machines<R> {
    /// What the rotor does at a bearing.
    #[inline(always)]
    fn contact(
        &self,
        k: usize,
        state: &[R],
        centre: &GeometricCentre<R>,
        spin: R,
    ) -> ContactReaction<R> {
        let inner = self.layout.bearings[k].motion(state).inner;
        self.bearings[k].contact(centre, spin, &inner)
    }

    /// The rate of change of the state, and the probes where asked.
    #[inline(always)]
    pub(super) fn rate_of_change(
        &self,
        mode: &Mode<R>,
        state: &[R],
        rate: &mut [R],
        probe: &mut [R],
    ) {
        let dimension = self.layout.dimension();
        let (state, rate) = (&state[..dimension], &mut rate[..dimension]);
        let layout = &self.layout;
        let zero = R::zero();

        // what acts on the rotor
        let rotor = rotor_motion(state);
        let centre = self.rotor.geometric_centre(&rotor);
        let levitation = self.levitation.force(centre.position, centre.velocity) * mode.levitation;
        let mut on_rotor = Wrench::planar(levitation, centre.arm.cross(levitation));
        let first = self.contact(0, state, &centre, rotor.spin);
        on_rotor += first.on_journal;
        for k in 1..self.bearings.len() {
            on_rotor += self.contact(k, state, &centre, rotor.spin).on_journal;
        }
        let braking = mode.brake.greater(zero);
        let brake = if braking.any() {
            R::select(braking, self.rotor.brake_moment(rotor.spin), zero)
        } else {
            zero
        };

        // rotor
        let (rotor_torque, spin_rate) = if self.rotor.spin_held {
            (-on_rotor.moment, zero)
        } else {
            (
                brake,
                (on_rotor.moment + brake) * self.inverse_polar_inertia,
            )
        };
        let acceleration = on_rotor.force * self.inverse_mass + self.gravity;
        write_body(rate, ROTOR, rotor.velocity, acceleration);
        rate[ROTOR + 4] = rotor.spin;
        rate[ROTOR + 5] = spin_rate;
        rate[layout.source(0)] = levitation.dot(centre.velocity);
        rate[layout.source(1)] = rotor_torque * rotor.spin;
        debug_assert!(ROTOR_SOURCES.len() == 2);

        // auxiliary bearings; C = G + arm: its acceleration has the centripetal and the spin-up part of the eccentricity
        let of_centre =
            acceleration + centre.arm.turned() * spin_rate - centre.arm * rotor.spin.square();
        let mut impulse = rotor.position.cross(self.gravity) * self.rotor.mass;
        for (k, (part, at)) in self.bearings.iter().zip(&layout.bearings).enumerate() {
            let motion = at.motion(state);
            let reaction = part.bearing(at, &motion, state, rate, probe);
            let node = AtNode {
                centre,
                acceleration: of_centre,
                contact: if k == 0 {
                    first
                } else {
                    self.contact(k, state, &centre, rotor.spin)
                },
            };
            let external = part.accelerate(
                at,
                &node,
                self.gravity,
                &motion,
                &reaction,
                Outlet {
                    heat: layout.heat(at.heat),
                    source: layout.source(at.source),
                    rate: &mut *rate,
                    probe: &mut *probe,
                },
            );
            for moment in external.weights {
                impulse += moment;
            }
            if k == 0 {
                impulse += centre.position.cross(levitation);
                impulse += rotor_torque;
            }
            for moment in external.others {
                impulse += moment;
            }
        }
        rate[layout.angular_impulse()] = impulse;
    }
}
