//! Heads of text files that name columns, units and clocks in a form of their own, and midnights in clock times.

use crate::tables::{all, channel};
use recording::file::csv::Csv;
use recording::{Clock, Recording};
use std::fmt::Write as _;
use std::io::Cursor;

fn open(text: &str) -> Csv<Cursor<Vec<u8>>> {
    Csv::from_source(Cursor::new(text.as_bytes().to_vec()), "x".as_ref()).unwrap()
}

/// Names with units.
fn heads(file: &dyn Recording) -> Vec<(String, String)> {
    let channels = file.channels().iter();
    channels.map(|c| (c.name.clone(), c.unit.clone())).collect()
}

fn named(heads: &[(&str, &str)]) -> Vec<(String, String)> {
    let heads = heads.iter();
    heads.map(|(a, b)| (a.to_string(), b.to_string())).collect()
}

fn uniform(first: f64, interval: f64) -> Clock {
    Clock::Uniform { first, interval }
}

/// A file of LabVIEW: lines of its first head, of its second, names, and rows.
fn labview(separator: &str, lines: [&str; 4], head: &[&str], rows: &[String]) -> String {
    let [word, decimals, columns, names] = lines;
    let mut text = format!(
        "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\t{word}\nDecimal_Separator\t{decimals}\nMulti_Headings\tNo\nX_Columns\t{columns}\nTime_Pref\tAbsolute\nDate\t2024/03/05\n***End_of_Header***\t\n\t\n"
    )
    .replace('\t', separator);
    for line in head.iter().chain([&"***End_of_Header***", &names]) {
        text += &line.replace('\t', separator);
        text += "\n";
    }
    for row in rows {
        text += &row.replace('\t', separator);
        text += "\n";
    }
    text
}

const HEAD: [&str; 6] = [
    "Channels\t3\t\t\t",
    "Samples\t1000\t1000\t1\t",
    "Y_Unit_Label\trad/s\tN mm\tdegC\t",
    "X_Dimension\tTime\tTime\tTime\t",
    "X0\t0.0000000000000000E+0\t0\t0\t",
    "Delta_X\t0.002000\t0.002000\t1.000000\t",
];

#[test]
fn the_head_of_labview_names_columns_and_no_row_is_lost() {
    for (separator, word, decimals) in [("\t", "Tab", "."), (",", "Comma", "."), ("\t", "Tab", ",")]
    {
        for count in [3, 97, 3000] {
            let rows: Vec<String> = (0..count)
                .map(|k| {
                    let (time, torque) = (0.002 * f64::from(k), f64::from(k % 7) / 8.0);
                    let temperature = if k == 0 { "20.5" } else { "" };
                    format!(
                        "{time:.6}\t{:.6}\t{torque}\t{temperature}",
                        120.0 - 6.0 * time
                    )
                    .replace('.', decimals)
                })
                .collect();
            let names = "X_Value\tspeed\ttorque\ttemp\tComment";
            let mut file = open(&labview(
                separator,
                [word, decimals, "One", names],
                &HEAD,
                &rows,
            ));
            let expected = [
                ("X_Value", "s"),
                ("speed", "rad/s"),
                ("torque", "N mm"),
                ("temp", "degC"),
            ];
            assert_eq!(heads(&file), named(&expected));
            let speed = all(&mut file, "speed");
            assert_eq!(speed.len(), count as usize);
            assert_eq!((speed[0], speed[2]), (120.0, 119.976));
            let temperature = all(&mut file, "temp");
            assert_eq!(temperature[0], 20.5);
            assert!(temperature[1..].iter().all(|value| value.is_nan()));
            let clock = &file.channels()[channel(&file, "torque")].clock;
            assert_eq!(*clock, uniform(0.0, 0.002));
        }
    }
}

#[test]
fn columns_of_labview_may_have_times_of_their_own_or_none() {
    let head = [
        "Channels\t2\t\t\t",
        "Samples\t3\t\t3\t",
        "Y_Unit_Label\tVolts\t\tg\t",
        "X_Dimension\tTime\t\tTime\t",
        "X0\t0.5\t\t0\t",
        "Delta_X\t1.953125E-5\t\t1E-3\t",
    ];
    let rows: Vec<String> = (0..3)
        .map(|k| {
            let own = [0.5 + 1.953125e-5 * f64::from(k), 1e-3 * f64::from(k)];
            format!("{:.6}\t{k}.5\t{:.6}\t-{k}.25", own[0], own[1])
        })
        .collect();
    let names = "X_Value\tVoltage\tX_Value\tAcceleration\tComment";
    let text = labview("\t", ["Tab", ".", "Multi", names], &head, &rows);
    let mut file = open(&text);
    assert_eq!(all(&mut file, "Voltage"), [0.5, 1.5, 2.5]);
    assert_eq!(all(&mut file, "Acceleration"), [-0.25, -1.25, -2.25]);
    let clock = |file: &dyn Recording, name| file.channels()[channel(file, name)].clock.clone();
    assert_eq!(clock(&file, "Voltage"), uniform(0.5, 1.953125e-5));
    assert_eq!(clock(&file, "Acceleration"), uniform(0.0, 1e-3));
    // A second head between the rows is none of them, and the columns of times hold on.
    let from = text.find("Channels").unwrap();
    let mut file = open(&format!("{text}{}", &text[from..]));
    assert_eq!(all(&mut file, "Voltage").len(), 6);
    let times = channel(&file, "X_Value Acceleration");
    assert_eq!(clock(&file, "Acceleration"), Clock::Channel(times));
    assert!(file.notes().iter().any(|n| n.text.contains("1 more heads")));
    // Without a column of times its cell is empty, or is not there.
    for lead in ["\t", ""] {
        let rows: Vec<String> = (0..3).map(|k| format!("{lead}{k}.5\t-{k}")).collect();
        let head = [
            "Y_Unit_Label\tV\trpm\t",
            "X0\t0\t0\t",
            "Delta_X\t1E-3\t1E-3\t",
        ];
        let names = "X_Value\ta\tb\tComment";
        let mut file = open(&labview("\t", ["Tab", ".", "No", names], &head, &rows));
        assert_eq!(heads(&file), named(&[("a", "V"), ("b", "rpm")]));
        assert_eq!(all(&mut file, "b"), [0.0, -1.0, -2.0]);
        assert_eq!(clock(&file, "a"), uniform(0.0, 1e-3));
    }
}

#[test]
fn oscilloscopes_state_names_units_and_clock_in_their_heads() {
    let mut rigol = String::from("X,CH1,CH2,Start,Increment,\nSequence,Volt,V,-0.25,1.0e-04,\n");
    let mut keysight = String::from("x-axis,1,2\nsecond,Volt,V\n");
    let mut mso = String::from(
        "Model,MSO44\nHorizontal Units,s\nSample Interval,1e-4\nVertical Units,V\n\nTIME,CH1\n",
    );
    let mut tds = String::new();
    let beside = [
        "Record Length,6.0e+01",
        "Sample Interval,1.0e-04",
        "Source,CH1",
        "Vertical Units,V",
        "Horizontal Units,s",
    ];
    for k in 0..60 {
        let (time, value) = (1e-4 * f64::from(k) - 0.25, f64::from(k) / 8.0);
        writeln!(rigol, "{k},{value:.3e},-1.0,").unwrap();
        writeln!(keysight, "{time:+.6E},{value:+.3E},-1.0E+00").unwrap();
        writeln!(mso, "{time:.6},{value}").unwrap();
        let head = beside.get(k as usize).unwrap_or(&",");
        writeln!(tds, "{head},,{time:.9},{value},").unwrap();
    }
    for (text, name) in [(rigol, "CH1"), (keysight, "1"), (mso, "CH1"), (tds, "CH1")] {
        let mut file = open(&text);
        let index = channel(&file, name);
        assert_eq!(file.channels()[index].clock, uniform(-0.25, 1e-4), "{text}");
        assert!(["V", "Volt"].contains(&file.channels()[index].unit.as_str()));
        let values = all(&mut file, name);
        let wanted: Vec<f64> = (0..60).map(|k| f64::from(k) / 8.0).collect();
        assert_eq!(values.len(), 60);
        assert!(
            values.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 4e-3),
            "{values:?}"
        );
    }
}

#[test]
fn times_of_the_day_go_on_after_midnight() {
    let mut text = String::from("Time;speed [rpm]\n");
    for k in 0..20_000 {
        let time = (86_398.0 + 0.01 * f64::from(k)) % 86_400.0;
        let (hour, rest) = ((time / 3600.0).floor(), time % 3600.0);
        let (minute, second) = ((rest / 60.0).floor(), rest % 60.0);
        writeln!(text, "{hour:02}:{minute:02}:{second:06.3};{k}").unwrap();
    }
    let mut file = open(&text);
    let clock = file.channels()[channel(&file, "speed")].clock.clone();
    assert_eq!(clock, uniform(86_398.0, 0.01));
    // Blocks may be read in any order.
    let mut late = [0.0];
    let time = channel(&file, "Time");
    file.read(time, 19_999, &mut late).unwrap();
    assert!((late[0] - 86_597.99).abs() < 1e-6);
    let times = all(&mut file, "Time");
    assert!(times.windows(2).all(|pair| pair[1] > pair[0]));
}
