//! The command line as types; its texts are what `--help` prints.

use auxbear::problem::Result;
use auxbear::report::directory::free_path;
use auxbear::scenario::{BuiltIn, KINDS, Scenario};
use clap::{Args, Parser, Subcommand};
use std::path::{Path, PathBuf};

/// What happens when a magnetically levitated rotor falls onto its auxiliary rolling bearings, how these bearings are brought
/// to speed, which torque they make, and what measurements of them say.
#[derive(Debug, Parser)]
#[command(
    name = "auxbear",
    version,
    after_help = "Start with `auxbear new drop my_drop.toml` (or another kind, see `auxbear help new`), then `auxbear run my_drop.toml`.\n\
                  Exit status: 0 done, 1 the run failed, 2 the input is wrong, 130 interrupted."
)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Simulate what a file describes and write a run directory
    Run(Run),
    /// Run a scenario many times with values that differ: sweep, Monte Carlo, sensitivity; go on where it stopped
    Study(Study),
    /// Run every case of a qualification and write its document; go on where it stopped
    Qualify(Qualify),
    /// Show the moments of one bearing over speed, load and acceleration, and write a run directory
    Torque(Torque),
    /// Compute speed, torque and cage speed from the channels of a measurement file, and write a run directory
    Signals(Measured),
    /// Find what measured tests show of a bearing: friction, loss, slip, and which explanation they support
    Identify(Measured),
    /// Analyse a flexible rotor, also that of a machine: modes, critical speeds, response to unbalance; write a run directory
    Rotor(Measured),
    /// Show the dynamic stiffness of the mounts of a drop or machine over frequency, fit O-ring branches to a measured one
    Mount(Mount),
    /// Write the machine of a drop or machine file without its controllers as a co-simulation unit, FMI 2.0 or 3.0
    #[cfg(feature = "fmu")]
    Fmu(Fmu),
    /// Make a rotor file of this program from a rotor saved by ROSS, or from a table of sections
    Import(Import),
    /// Read and check a file, print it with every default and its unit; run nothing
    Check(ScenarioArguments),
    /// List results and columns of a run of a file, with units and meanings; run nothing
    Results(ScenarioArguments),
    /// Write a commented starting file
    New {
        #[arg(help = format!("What to describe: {}", KINDS.join(", ")))]
        kind: String,
        /// File to write; printed if none is given, or for -
        path: Option<PathBuf>,
    },
    /// Print the JSON Schema of a kind of file, by which editors complete and check it
    Schema {
        #[arg(help = format!("Kind of file: {}, summary (of a run directory)", KINDS.join(", ")))]
        kind: String,
    },
    /// Draw the HTML report of one run again, or of several side by side
    Report {
        /// Run directories
        #[arg(required = true, value_name = "DIR")]
        directories: Vec<PathBuf>,
        /// File to write, *.html, or *.svg for one run as a picture [one run: its own report.html; several: comparison.html here]
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// Open a local page that edits, runs, shows and compares what is in a folder
    Studio(Studio),
    /// Add up the drops of a service, so many of each run: rolling fatigue, wear, and the worst of what does not add up
    Service(Service),
    /// Write results and histories of a run as tables for other programs
    Export {
        /// Run directory
        #[arg(value_name = "DIR")]
        directory: PathBuf,
        /// A folder of CSV files: results, members, history and more
        #[arg(long, required_unless_present = "xlsx", conflicts_with = "xlsx")]
        csv: bool,
        /// A workbook with a sheet for each of these
        #[arg(long)]
        xlsx: bool,
        /// Folder or file to write [csv/ or run.xlsx in the run directory]
        #[arg(long, value_name = "PATH")]
        out: Option<PathBuf>,
        /// Write this result or column alone, with others that are named so; * stands for one name between dots, as in '*.peak_contact_force'
        #[arg(long, value_name = "NAME")]
        only: Vec<String>,
    },
    /// Run published and reference cases and print how far the results lie from them
    Validate {
        /// Folder with more cases, besides those that ship
        #[arg(long, value_name = "DIR")]
        cases: Option<PathBuf>,
        /// Run cases too that take half a minute and more
        #[arg(long = "long")]
        all: bool,
        /// Print JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Print what a code of a message means and what to do
    Explain {
        /// Code as the message prints it, e.g. AB1007
        code: String,
    },
    /// The catalogue of bearings
    Bearings {
        #[command(subcommand)]
        command: Bearings,
    },
}

/// A scenario.
#[derive(Debug, Args)]
pub struct ScenarioArguments {
    /// Scenario file; `auxbear new` writes one to start from
    pub file: PathBuf,
    /// Override a value of the file, e.g. bearing.name=6005 or mount.stiffness="1e7 N/m"; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
}

/// Where results go.
#[derive(Debug, Args)]
pub struct Output {
    /// Run directory to write [runs/NAME of the file or runs/torque-BEARING, with a number where that is taken]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print no progress and no tables; warnings, problems and fitted lines are printed all the same
    #[arg(long)]
    pub quiet: bool,
}

impl ScenarioArguments {
    /// Reads the scenario.
    pub fn read(&self) -> Result<Scenario> {
        Scenario::read(&self.file, &self.set, &BuiltIn)
    }
    /// Name of the file without its ending.
    pub fn name(&self) -> String {
        stem(&self.file)
    }
}

impl Output {
    /// The run directory asked for, or a free one of this name.
    pub fn place(&self, name: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| free_path(name))
    }
}

/// Name of a file without its ending.
pub fn stem(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

#[derive(Debug, Args)]
pub struct Run {
    #[command(flatten)]
    pub given: ScenarioArguments,
    #[command(flatten)]
    pub output: Output,
    /// Number of runs of a drop, from sampled unbalance angles and perturbed starts; the same as --set repeat.count=N
    #[arg(long, value_name = "N")]
    pub repeat: Option<String>,
    /// Number of threads [all cores]; the numbers do not depend on it
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub threads: Option<String>,
}

#[derive(Debug, Args)]
pub struct Study {
    /// Study file; `auxbear new study` writes one to start from
    pub file: PathBuf,
    /// Study directory to begin or to go on with [runs/NAME of the file]; with --member the run directory
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [all cores]; the numbers do not depend on it
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub threads: Option<String>,
    /// Blocks to add to the design: members of monte carlo and sobol, whole hypercubes, trajectories or blocks of the others
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub add: Option<String>,
    /// Run this member alone again, with its own run directory
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    pub member: Option<String>,
    /// Print no progress and no tables; warnings and problems are printed all the same
    #[arg(long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub struct Qualify {
    /// Study file with [design] kind = "qualification"
    pub file: PathBuf,
    /// Directory to begin or to go on with [runs/NAME of the file]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [all cores]; the numbers do not depend on it
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub threads: Option<String>,
    /// Print no progress and no tables; warnings and problems are printed all the same
    #[arg(long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub struct Measured {
    #[command(flatten)]
    pub given: ScenarioArguments,
    #[command(flatten)]
    pub output: Output,
}

#[derive(Debug, Args)]
pub struct Mount {
    #[command(flatten)]
    pub given: ScenarioArguments,
    /// Table of a measured stiffness to fit: columns frequency, storage (K') and loss (K''), each with its unit, e.g. "frequency [Hz]"
    #[arg(long, value_name = "TABLE")]
    pub fit: Option<PathBuf>,
    /// Amplitude at which friction rings count
    #[arg(long, value_name = "LENGTH", default_value = "10 um")]
    pub amplitude: String,
    #[command(flatten)]
    pub output: Output,
}

#[cfg(feature = "fmu")]
#[derive(Debug, Args)]
pub struct Fmu {
    #[command(flatten)]
    pub given: ScenarioArguments,
    /// File to write [NAME.fmu of the file]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// What commands the magnets: current, voltage, force; with force stiffness, limits and loss of the magnets are the user's
    #[arg(long, value_name = "KIND", default_value = "current")]
    pub input: String,
    /// Version of FMI: 2 or 3
    #[arg(long, value_name = "N", default_value = "2")]
    pub version: String,
    /// Library of another platform, or another one than that beside the program; repeated for several platforms
    #[arg(long, value_name = "FILE")]
    pub library: Vec<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Service {
    /// Number of drops and the directory of a run of one, e.g. 40:runs/full_speed
    #[arg(required = true, value_name = "COUNT:DIR")]
    pub occasions: Vec<String>,
}

#[derive(Debug, Args)]
pub struct Studio {
    /// Folder with input files and runs, made where there is none [this folder]
    pub folder: Option<PathBuf>,
    /// Port on this machine [any free one]
    #[arg(long, value_name = "N")]
    pub port: Option<u16>,
    /// Print the address only; open no browser
    #[arg(long)]
    pub no_browser: bool,
    /// Make, run and show one of each kind in a temporary folder, and say what came out
    #[arg(long, conflicts_with_all = ["folder", "port", "no_browser"])]
    pub selftest: bool,
}

#[derive(Debug, Args)]
pub struct Import {
    /// Rotor saved by ROSS 2 or 3 (TOML or JSON), or a table of sections (CSV or XLSX) with units in its header
    pub file: PathBuf,
    /// File to write [printed if none is given]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Torque {
    /// Name of the bearing, e.g. 6005
    pub bearing: String,
    /// Law of the friction moment: palmgren, "palmgren printed", skf or measured; repeated, they are compared
    #[arg(long)]
    pub law: Vec<String>,
    /// Largest speed of the inner race, e.g. "200 rad/s"
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true)]
    pub speed_to: Option<String>,
    /// Radial load, e.g. "80 N"; may be repeated
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true)]
    pub load: Vec<String>,
    /// Acceleration of the inner race, e.g. "7200 rad/s^2"; may be repeated
    #[arg(long, allow_hyphen_values = true)]
    pub acceleration: Vec<String>,
    /// Temperature of the lubricant, e.g. "60 degC"; repeated, the first is the running temperature
    #[arg(long)]
    pub temperature: Vec<String>,
    /// Lubricant, e.g. "ISO VG 68, 8.7 mm^2/s at 100 degC"; repeated, they are compared
    #[arg(long)]
    pub lubricant: Vec<String>,
    /// File with more bearings, or with others of the same names
    #[arg(long, value_name = "FILE")]
    pub catalogue: Option<PathBuf>,
    /// Set any value of the scenario, e.g. bearing.moment.f0=2; may be repeated
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    #[command(flatten)]
    pub output: Output,
}

/// Equilibrium and stiffness of a bearing.
#[derive(Debug, Args)]
pub struct Stiffness {
    /// Name of the bearing, e.g. 6005
    #[arg(required = true)]
    pub name: Vec<String>,
    /// Force along the axis on the inner ring, e.g. "200 N"
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true)]
    pub axial: Option<String>,
    /// Force across the axis, along x
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true)]
    pub radial: Option<String>,
    /// Moment about y
    #[arg(long, value_name = "MOMENT", allow_hyphen_values = true)]
    pub moment: Option<String>,
    /// Speed of the inner ring, e.g. "20000 rpm"
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true)]
    pub speed: Option<String>,
    /// Free contact angle, e.g. "15 deg", in place of the catalogue's
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub contact_angle: Option<String>,
    /// Diametral clearance of a deep-groove bearing, e.g. "10 um", from which the free contact angle follows
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub clearance: Option<String>,
    /// single, DB (back to back), DF (face to face), DT (tandem); sets TBT, TFT, TT, QBC, QFC, QBT, QFT, QT
    #[arg(long)]
    pub arrangement: Option<String>,
    /// Preload of a pair or set as a force, e.g. "65 N"
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true)]
    pub preload: Option<String>,
    /// Preload of a pair or set as the distance by which it is closed, e.g. "8 um"
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub offset: Option<String>,
    /// Stiffness of a spring that keeps --preload, e.g. "1e6 N/m": the outer rings of the rows that carry thrust towards -z slide against it
    #[arg(long, value_name = "STIFFNESS")]
    pub preload_spring: Option<String>,
    /// Compression beyond that of the preload at which this spring is solid, e.g. "0.2 mm"
    #[arg(long, value_name = "LENGTH")]
    pub spring_travel: Option<String>,
    /// Distance of the rows; else the width of a bearing
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub spacing: Option<String>,
    /// Hypothesis of the balls' spin: half, outer, inner or outer_half
    #[arg(long, value_name = "WORD")]
    pub race_control: Option<String>,
    /// File with more bearings, or with others of the same names
    #[arg(long, value_name = "FILE")]
    pub catalogue: Option<PathBuf>,
    /// Print JSON with every ball instead of tables
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Subcommand)]
pub enum Bearings {
    /// List the bearings, all or those asked for
    List {
        /// Bore: "25 mm", or a range "20 mm..30 mm", which may be open: "20 mm.."
        #[arg(long, value_name = "LENGTH")]
        bore: Option<String>,
        /// Least limiting speed, e.g. "20000 rpm"
        #[arg(long, value_name = "SPEED")]
        speed: Option<String>,
        /// Type, e.g. "deep groove" or "angular contact"
        #[arg(long = "type", value_name = "TYPE")]
        kind: Option<String>,
        /// Material of the balls: "steel" or "silicon nitride"
        #[arg(long)]
        material: Option<String>,
        /// File with more bearings, or with others of the same names
        #[arg(long, value_name = "FILE")]
        catalogue: Option<PathBuf>,
        /// Print JSON with every value instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Show every number of one bearing with its source
    Show {
        /// Name of the bearing, e.g. 6005
        #[arg(required = true)]
        name: Vec<String>,
        /// File with more bearings, or with others of the same names
        #[arg(long, value_name = "FILE")]
        catalogue: Option<PathBuf>,
        /// Print JSON instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Compute equilibrium and stiffness of a bearing, or of a pair, under loads and speed
    Stiffness(Box<Stiffness>),
}
