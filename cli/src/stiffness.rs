//! `auxbear bearings stiffness`: equilibrium and stiffness of a bearing or a pair.

use crate::arguments::Stiffness;
use crate::{bearings, console};
use auxbear::problem::Result;
use auxbear::run::stiffness::answer::Ball;
use auxbear::run::stiffness::{self, Answer, Request, Typed};

/// What messages name as the file.
const PLACE: &str = "auxbear bearings stiffness";

/// Computes and prints it.
pub fn perform(wish: &Stiffness) -> Result<()> {
    let catalogue = bearings::read(wish.catalogue.as_deref())?;
    let name = wish.name.join(" ");
    let meant = catalogue.meant(&name, PLACE)?;
    let typed = Typed {
        texts: &[
            ("--axial", wish.axial.as_deref()),
            ("--radial", wish.radial.as_deref()),
            ("--moment", wish.moment.as_deref()),
            ("--speed", wish.speed.as_deref()),
            ("--contact-angle", wish.contact_angle.as_deref()),
            ("--clearance", wish.clearance.as_deref()),
            ("--arrangement", wish.arrangement.as_deref()),
            ("--preload", wish.preload.as_deref()),
            ("--offset", wish.offset.as_deref()),
            ("--preload-spring", wish.preload_spring.as_deref()),
            ("--spring-travel", wish.spring_travel.as_deref()),
            ("--spacing", wish.spacing.as_deref()),
            ("--race-control", wish.race_control.as_deref()),
        ],
        place: PLACE,
    };
    let answer = stiffness::run(&Request::read(&meant, &typed)?, PLACE)?;
    bearings::report(&meant, &name, &meant.left_out);
    console::print(&if wish.json {
        answer.to_json()
    } else {
        text(&answer)
    })?;
    console::warn(&answer.warnings);
    Ok(())
}

/// A number to so many digits after the point.
fn digits(value: f64, after: usize) -> String {
    let text = format!("{value:.after$}");
    // no minus before a rounded zero
    let zero = text
        .trim_start_matches('-')
        .chars()
        .all(|c| matches!(c, '0' | '.'));
    if zero {
        text.trim_start_matches('-').to_string()
    } else {
        text
    }
}

fn text(answer: &Answer) -> String {
    let asked = &answer.asked;
    let angle = digits(asked.free_angle.to_degrees(), 2);
    let mut text = format!(
        "{}, {}, free contact angle {angle} deg, race control: {}\n",
        asked.name,
        asked.words()[0],
        asked.words()[1]
    );
    if answer.offset > 0.0 {
        let thrusts = answer.preload_thrusts.iter().flatten();
        let thrusts: Vec<String> = thrusts
            .map(|own| format!("{} N", digits(own.abs(), 1)))
            .collect();
        let closed = digits(1e6 * answer.offset, 2);
        text.push_str(&format!(
            "pair closed by {closed} um; thrust of its rows at this speed without load: {}\n",
            thrusts.join(", ")
        ));
    }
    if let Some([compression, force]) = answer.spring {
        text.push_str(&format!(
            "preload spring under the rows that carry thrust towards -z: {} N, compressed by {} um more than at rest\n",
            digits(force, 1),
            digits(1e6 * compression, 2)
        ));
    }
    let [x, y, z] = answer.displacement.shift.map(|own| digits(1e6 * own, 3));
    let [a, b] = answer.displacement.tilt.map(|own| digits(1e3 * own, 4));
    text.push_str(&format!(
        "displacement of the inner ring: x {x} um, y {y} um, z {z} um; tilt about x {a} mrad, about y {b} mrad\n\n"
    ));
    let head = [
        "row",
        "thrust",
        "most loaded ball",
        "contact angle inner outer",
        "pressure inner outer",
        "cage speed",
        "spin inner outer",
    ];
    let units = ["", "N", "deg: N N", "deg", "MPa", "of the ring", "rad/s"];
    let mut rows = vec![head.map(String::from), units.map(String::from)];
    for (index, balls) in answer.rows.iter().enumerate() {
        // of balls that carry the same the first
        let most = balls.iter().reduce(|most, ball| {
            let more = ball.loads[1] > most.loads[1] * (1.0 + 1e-9);
            if more { ball } else { most }
        });
        rows.extend(most.map(|ball| row(answer, index, ball)));
    }
    text.push_str(&console::table(&rows));
    text.push_str(
        "\nstiffness: forces N, moments N m (rows) over displacements m, tilts rad (columns)\n",
    );
    let names = ["Fx", "Fy", "Fz", "Mx", "My"];
    let mut rows = vec![["", "x", "y", "z", "tilt x", "tilt y"].map(String::from)];
    let largest = |k: usize| answer.stiffness[k][k].abs();
    for (k, name) in names.into_iter().enumerate() {
        let mut cells = [
            name.to_string(),
            String::new(),
            String::new(),
            String::new(),
            String::new(),
            String::new(),
        ];
        for (j, value) in answer.stiffness[k].iter().enumerate() {
            // what symmetry makes zero
            let small = value.abs() < 1e-9 * (largest(k) * largest(j)).sqrt();
            cells[j + 1] = if small {
                "0".to_string()
            } else {
                format!("{value:.4e}")
            };
        }
        rows.push(cells);
    }
    text.push_str(&console::table(&rows));
    text
}

fn row(answer: &Answer, index: usize, ball: &Ball) -> [String; 7] {
    let speed = answer.asked.speed;
    let pair = |[a, b]: [f64; 2], scale: f64, after: usize| {
        format!("{} {}", digits(scale * a, after), digits(scale * b, after))
    };
    let degrees = 1_f64.to_degrees();
    [
        (index + 1).to_string(),
        digits(answer.thrusts[index], 1),
        format!(
            "{}: {}",
            digits(degrees * ball.azimuth, 0),
            pair(ball.loads, 1.0, 1)
        ),
        pair(ball.angles, degrees, 2),
        pair(ball.pressures, 1e-6, 0),
        if speed == 0.0 {
            "-".to_string()
        } else {
            digits(ball.cage_speed / speed, 4)
        },
        pair(ball.spins, 1.0, 0),
    ]
}
