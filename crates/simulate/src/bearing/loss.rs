//! The loss of accelerated balls, and tables, from rows of a scenario.

use model::bearing::AccelerationLoss as LossLaw;
use model::table::Table;
use scenario::AccelerationLoss;

/// The law with its constants.
pub fn law(loss: &AccelerationLoss) -> LossLaw {
    match loss {
        AccelerationLoss::None => LossLaw::None,
        AccelerationLoss::Constant { force } => LossLaw::Constant { force: *force },
        AccelerationLoss::Proportional { per_acceleration } => LossLaw::Proportional {
            per_acceleration: *per_acceleration,
        },
        AccelerationLoss::OverSpeed { force_over_speed } => LossLaw::OverSpeed {
            force: table(force_over_speed, 1.0),
        },
        AccelerationLoss::Affine {
            force_over_speed,
            per_acceleration_over_speed,
        } => LossLaw::Affine {
            force: table(force_over_speed, 1.0),
            per_acceleration: table(per_acceleration_over_speed, 1.0),
        },
    }
}

/// Rows as a table, whose values are multiplied by a factor.
pub(crate) fn table(rows: &[[f64; 2]], factor: f64) -> Table {
    let points = rows.iter().map(|[x, y]| (*x, factor * y)).collect();
    Table::through(points).expect("rows of a scenario are two at least, and rise")
}
