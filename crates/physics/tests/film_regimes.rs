//! Films between rigid bodies by an own solution of Reynolds' equation: thickness, saturation, sheared area.

use physics::film::{EntrainedContact, FilmGroups, piezoviscous_rigid_film, rigid_film};
use physics::hertz::{BallRace, PointContact, Race};
use physics::lubricant::FVA_3;
use physics::lubricant_traction::{Asperities, LubricatedContact, STEEL_SURFACE};
use physics::materials::{BEARING_STEEL, contact_modulus};

/// The film between two rigid paraboloids in its own measures.
///
/// x = X √(2 R_x h), y = Y √(2 R_y h), gap h (1 + X² + Y²), p = 12 η v √(2 R_x h)/h² P, D = R_x/R_y:
/// ∂/∂X(H³ ∂P/∂X) + D ∂/∂Y(H³ ∂P/∂Y) = 2X, P ≥ 0, and P = 0 on the edge: X = -30, Y = ±`half_width`.
struct Film {
    /// P and the area it stands on.
    cells: Vec<(f64, f64)>,
    /// ∬ θ/H, θ = 1 but behind the film, where streamers keep what flows: θ H constant.
    sheared: f64,
}

impl Film {
    /// ∬ P.
    fn load(&self) -> f64 {
        self.cells
            .iter()
            .map(|(pressure, area)| pressure * area)
            .sum()
    }
}

/// Finite volumes on lines at sinh, successive over-relaxation, half of the film.
fn solve(ratio: f64, half_width: f64) -> Film {
    const ALONG: usize = 100;
    const ACROSS: usize = 50;
    let line = |from: f64, to: f64, count: usize| -> Vec<f64> {
        let (from, to) = (from.asinh(), to.asinh());
        (0..=count)
            .map(|i| (from + (to - from) * i as f64 / count as f64).sinh())
            .collect()
    };
    let (x, y) = (line(-30.0, 3.0, ALONG), line(0.0, half_width, ACROSS));
    let gap = |x: f64, y: f64| 1.0 + x * x + y * y;
    let mid = |line: &[f64], i: usize| 0.5 * (line[i] + line[i + 1]);
    let mut p = vec![[0.0_f64; ACROSS + 1]; ALONG + 1];
    for _ in 0..5000 {
        let (mut change, mut sum) = (0.0, 0.0);
        for i in 1..ALONG {
            for j in 0..ACROSS {
                let (west, east) = (mid(&x, i - 1), mid(&x, i));
                let (south, north) = (if j > 0 { mid(&y, j - 1) } else { 0.0 }, mid(&y, j));
                let (dx, dy) = (east - west, north - south);
                let to_east = gap(east, y[j]).powi(3) / (x[i + 1] - x[i]) * dy;
                let to_west = gap(west, y[j]).powi(3) / (x[i] - x[i - 1]) * dy;
                let to_north = gap(x[i], north).powi(3) / (ratio * (y[j + 1] - y[j])) * dx;
                let (to_south, below) = if j > 0 {
                    let width = ratio * (y[j] - y[j - 1]);
                    (gap(x[i], south).powi(3) / width * dx, p[i][j - 1])
                } else {
                    (0.0, 0.0)
                };
                let inflow = (gap(east, y[j]) - gap(west, y[j])) * dy;
                let balance = (to_east * p[i + 1][j]
                    + to_west * p[i - 1][j]
                    + to_north * p[i][j + 1]
                    + to_south * below
                    - inflow)
                    / (to_east + to_west + to_north + to_south);
                let next = (p[i][j] + 1.85 * (balance - p[i][j])).max(0.0);
                change += (next - p[i][j]).abs();
                sum += next;
                p[i][j] = next;
            }
        }
        if change < 1e-8 * sum {
            break;
        }
    }
    let mut film = Film {
        cells: Vec::new(),
        sheared: 0.0,
    };
    for j in 0..ACROSS {
        let dy = 2.0 * (mid(&y, j) - if j > 0 { mid(&y, j - 1) } else { 0.0 });
        for (i, row) in p.iter().enumerate().take(ALONG).skip(1) {
            let area = (mid(&x, i) - mid(&x, i - 1)) * dy;
            film.cells.push((row[j], area));
        }
        let end = (1..ALONG)
            .rev()
            .find(|&i| p[i][j] > 0.0)
            .map_or(0.0, |i| x[i]);
        let root = gap(0.0, y[j]).sqrt();
        // ∫ dX/H before, ∫ H(end)/H² dX behind the end of the pressure, closed: to X = -∞ and ∞
        let before = ((end / root).atan() + std::f64::consts::FRAC_PI_2) / root;
        let square = 0.5
            * ((std::f64::consts::FRAC_PI_2 - (end / root).atan()) / root.powi(3)
                - end / (root * root * gap(end, y[j])));
        film.sheared += dy * (before + gap(end, y[j]) * square);
    }
    film
}

#[test]
fn the_rigid_film_is_that_of_reynolds_equation() {
    // Q = 24 √2 η v R_x √R_y/√h ∬P: H = 1152 α_r (∬P)² (U/W)². The printed fit is 9 % above this solution, whose
    // film is 6 % low by its edge at 30.
    let groups = FilmGroups {
        speed: 1e-10,
        material: 4000.0,
        load: 1e-7,
    };
    for ratio in [1.0, 42.0] {
        let own = 1152.0 * ratio * (solve(ratio, 30.0).load() * groups.speed / groups.load).powi(2);
        let printed = rigid_film(groups, ratio);
        assert!(
            (0.88..1.0).contains(&(own / printed)),
            "{ratio}: {own:e} {printed:e}"
        );
    }
}

#[test]
fn the_thicker_rigid_film_is_that_of_reynolds_equation_of_stiffening_oil() {
    // With q = (1 - e^(-αp))/α Reynolds' equation is that of constant viscosity; αq = g P, αp = -ln(1 - g P), and g P < 1:
    // H^1.5 = 12 √2 G U/g, W = 24 √2 U √α_r H^-0.5 ∬ αp/g. From nearly constant viscosity to the end of all solutions.
    let ratio = 42.0;
    let film = solve(ratio, 30.0);
    let peak = film.cells.iter().map(|cell| cell.0).fold(0.0, f64::max);
    let (speed, material): (f64, f64) = (1e-10, 4000.0);
    let mut regimes = [0; 2];
    for share in [0.1, 0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99] {
        let stiffening = share / peak;
        let own = (12.0 * 2_f64.sqrt() * material * speed / stiffening).powf(2.0 / 3.0);
        let integral: f64 = film
            .cells
            .iter()
            .map(|(p, area)| -(-stiffening * p).ln_1p() / stiffening * area)
            .sum();
        let load = 24.0 * (2.0 * ratio).sqrt() * speed / own.sqrt() * integral;
        let groups = FilmGroups {
            speed,
            material,
            load,
        };
        let printed = [
            rigid_film(groups, ratio),
            piezoviscous_rigid_film(groups, ratio),
        ];
        regimes[usize::from(printed[1] > printed[0])] += 1;
        // 10 % where both meet, 6 % by the edge of the solution
        let thicker = printed[0].max(printed[1]);
        assert!(
            (0.93..1.11).contains(&(own / thicker)),
            "{share}: {own:e} {printed:?}"
        );
    }
    assert!(regimes[0] > 1 && regimes[1] > 1);
}

#[test]
fn light_contacts_shear_the_oil_of_the_gap_between_rigid_bodies() {
    let curvature = BallRace {
        ball_diameter: 7.94e-3,
        pitch_diameter: 38.5e-3,
        groove_curvature: 0.515,
        contact_angle: 0.0,
        race: Race::Inner,
    }
    .curvature();
    let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
    let contact = LubricatedContact {
        entrained: EntrainedContact::new(curvature, modulus).unwrap(),
        hertz: PointContact::new(curvature, modulus).unwrap(),
        lubricant: FVA_3.at(273.15 + 60.0, Some(0.134)).unwrap(),
        supply: 1.0,
        surfaces: [STEEL_SURFACE; 2],
        asperities: Asperities::raceway(0.1e-6, 0.001),
    };
    let law = contact.traction().unwrap();
    let EntrainedContact {
        rolling_radius,
        radius_ratio,
        ..
    } = contact.entrained;
    for (load, entrainment) in [(1.0, 3.0), (0.5, 3.0), (2.0, 10.0)] {
        let thickness = law.state(1e-6, load, entrainment).thickness;
        // the groove ends R_x from its middle
        let half_width = (rolling_radius / (2.0 * radius_ratio * thickness)).sqrt();
        let area =
            2.0 * rolling_radius * radius_ratio.sqrt() * solve(radius_ratio, half_width).sheared;
        let own = contact.lubricant.viscosity * area;
        let ours = load * law.slope_at_rest(load, entrainment);
        // 3/4 instead of the solution's streamers: 2 %; Hertz's ellipse of the law and some stiffening of the oil: 3 %
        assert!(
            (ours / own - 1.0).abs() < 0.05,
            "{load} N: {ours} {own} N s/m"
        );
        // of the order of 0.01 N s/m; with the elastic film and Hertz's pressure it was 0.07 at 1 N and 3 m/s
        assert!((0.005..0.02).contains(&ours), "{ours}");
    }
}
