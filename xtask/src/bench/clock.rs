//! CPU time of commands, and what the machine says about itself.

use std::time::Instant;

/// CPU seconds that the children of this process spent during `work`; wall seconds where the system does not say.
pub fn timed(work: impl FnOnce() -> Result<(), String>) -> Result<f64, String> {
    let (cpu, wall) = (children_seconds(), Instant::now());
    work()?;
    let spent = cpu.and_then(|before| Some(children_seconds()? - before));
    Ok(spent.unwrap_or_else(|| wall.elapsed().as_secs_f64()))
}

/// CPU seconds of all ended children so far, where the system reports them.
pub fn children_seconds() -> Option<f64> {
    children_ticks(&std::fs::read_to_string("/proc/self/stat").ok()?).map(|ticks| ticks / 100.0)
}

/// User and system time of ended children in ticks of 10 ms: fields 16 and 17, counted from behind the program's name,
/// which stands in brackets and may hold anything.
fn children_ticks(stat: &str) -> Option<f64> {
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(13);
    let user: f64 = fields.next()?.parse().ok()?;
    Some(user + fields.next()?.parse::<f64>().ok()?)
}

/// The middle value; the upper one of two.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Processor, vector unit, number of cores, load of the last minute, date, kind of time: what a table of times is worth
/// nothing without.
pub fn machine() -> String {
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = model_name(&cpuinfo).unwrap_or(std::env::consts::ARCH);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split_whitespace().next().unwrap_or("unknown");
    let today = std::process::Command::new("date")
        .args(["-u", "+%F"])
        .output();
    let today = today.map_or_else(|_| Vec::new(), |output| output.stdout);
    let today = String::from_utf8_lossy(&today).trim().to_owned();
    let kind = children_seconds().map_or("Wall time, as CPU time is not reported", |_| "CPU time");
    format!(
        "{processor}, {}, {cores} cores, load {load} before; {today}. {kind}.",
        level()
    )
}

fn model_name(cpuinfo: &str) -> Option<&str> {
    let line = cpuinfo
        .lines()
        .find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim())
}

/// The vector unit, by the rule of `number::Level`.
fn level() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        let is_wide = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        return if is_wide { "AVX-512" } else { "AVX2" };
    }
    "baseline"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_of_children_are_found_behind_any_program_name() {
        // proc(5): behind the name stand state (3) … stime (15), cutime (16), cstime (17)
        let stat = "7 (a) b 1) S 4 5 6 7 8 9 10 11 12 13 14 15 130 4 18";
        assert_eq!(children_ticks(stat), Some(134.0));
        assert_eq!(children_ticks("7 (a) S 4 5"), None);
    }

    #[test]
    fn the_processor_is_the_first_one_named() {
        let cpuinfo = "processor\t: 0\nmodel name\t: One @ 2.50GHz\nmodel name\t: Two\n";
        assert_eq!(model_name(cpuinfo), Some("One @ 2.50GHz"));
        assert_eq!(model_name("Features\t: fp asimd"), None);
    }

    #[test]
    fn one_slow_block_does_not_move_the_median() {
        assert_eq!(median(vec![1.0, 90.0, 1.2, 1.1, 0.9]), 1.1);
    }
}
