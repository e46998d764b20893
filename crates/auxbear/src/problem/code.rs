//! The kinds of wrong input, each with its stable code.

use std::fmt;

/// What kind of wrong input it is. The printed form (`AB0103`) is stable: a number is never used again for another thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Code {
    /// AB0001
    FileMissing,
    /// AB0002
    FileIsFolder,
    /// AB0003
    FileNotUtf8,
    /// AB0004
    FileEmpty,
    /// AB0005
    FileTooLarge,
    /// AB0006
    FileUnreadable,
    /// AB0100
    Syntax,
    /// AB0101
    UnknownKey,
    /// AB0102
    WrongType,
    /// AB0103
    BareNumber,
    /// AB0104
    UnreadableQuantity,
    /// AB0105
    WrongDimension,
    /// AB0106
    OutOfRange,
    /// AB0107
    MissingKey,
    /// AB0108
    UnknownWord,
    /// AB0109
    Conflict,
    /// AB0110
    UnusedKey,
    /// AB0111
    UnknownFormat,
    /// AB0112
    NotBuilt,
    /// AB0113
    UnreadableSet,
    /// AB0114
    TableOrder,
    /// AB0201
    UnknownBearing,
    /// AB0202
    BallsDoNotFit,
    /// AB0203
    BearingGeometry,
    /// AB0204
    ClearanceTooLarge,
    /// AB0205
    ContactAtStart,
    /// AB0206
    OutputInterval,
    /// AB0207
    TooManyRows,
    /// AB0208
    NoLawData,
    /// AB0209
    CreatesEnergy,
    /// AB0211
    Impossible,
    /// AB0212
    NotModelled,
    /// AB0213
    MeasurementInstead,
    /// AB0301
    OutputExists,
    /// AB0302
    OutputFailed,
    /// AB0303
    MeasurementUnreadable,
    /// AB0304
    UnknownChannel,
    /// AB0305
    ChannelClock,
    /// AB0306
    ChannelUnit,
    /// AB0307
    OutputPlace,
    /// AB0310
    CaseDamaged,
    /// AB0340
    UnknownQuantity,
    /// AB0401
    DuplicateBearing,
    /// AB0402
    RatingContradictsBalls,
    /// AB2000
    NoSuchNode,
    /// AB2001
    RotorGeometry,
    /// AB2002
    UnknownMaterial,
    /// AB2003
    TooManyModes,
    /// AB2004
    NotHeld,
    /// AB2005
    ImportFormat,
    /// AB2006
    SectionTable,
    /// AB2070
    ControllerSize,
    /// AB2071
    ControllerTime,
    /// AB2072
    ControllerFilter,
    /// AB2073
    MagnetValues,
    /// AB2074
    UnstableLevitation,
    /// AB2075
    ZeroStaticStiffness,
    /// AB2076
    CurrentLimit,
    /// AB2077
    LevitationParts,
    /// AB2078
    StartBeyondLimit,
    /// AB2200
    StudyScenario,
    /// AB2201
    StudyDesign,
    /// AB2202
    StudyCorrelation,
    /// AB2203
    StudyChanged,
    /// AB2204
    StudyInUse,
    /// AB2205
    StudyDamaged,
}

impl Code {
    /// Whether an input is refused for its form, whatever its size: key, type, unit, word.
    pub fn is_of_form(self) -> bool {
        use Code::*;
        matches!(
            self,
            Syntax
                | UnknownKey
                | WrongType
                | BareNumber
                | UnreadableQuantity
                | WrongDimension
                | UnknownWord
                | UnreadableSet
        )
    }

    /// Every code with its printed form, title and one sentence of explanation.
    const TABLE: &'static [(Code, &'static str, &'static str, &'static str)] = &[
        (
            Code::FileMissing,
            "AB0001",
            "File not found",
            "The input file does not exist at the path given.",
        ),
        (
            Code::FileIsFolder,
            "AB0002",
            "Folder instead of a file",
            "The path given names a folder where an input file is needed.",
        ),
        (
            Code::FileNotUtf8,
            "AB0003",
            "Not UTF-8 text",
            "Input files are text in UTF-8; this one holds other bytes, for example a binary file or an old code page.",
        ),
        (
            Code::FileEmpty,
            "AB0004",
            "Empty file",
            "The input file holds nothing but white space.",
        ),
        (
            Code::FileTooLarge,
            "AB0005",
            "File too large",
            "The input file is larger than 10 MB, so it is certainly not a scenario.",
        ),
        (
            Code::FileUnreadable,
            "AB0006",
            "File cannot be read",
            "The operating system refuses to read the input file.",
        ),
        (
            Code::Syntax,
            "AB0100",
            "Not valid TOML",
            "The file breaks a rule of the TOML format at the line named.",
        ),
        (
            Code::UnknownKey,
            "AB0101",
            "Unknown key",
            "A key or section is not one that the format knows; a misspelt key is never ignored.",
        ),
        (
            Code::WrongType,
            "AB0102",
            "Wrong kind of value",
            "The value is of another kind than the key takes, for example a list where a quantity is needed.",
        ),
        (
            Code::BareNumber,
            "AB0103",
            "Number without a unit",
            "The key takes a quantity, which is a text of number and unit; no unit is ever guessed.",
        ),
        (
            Code::UnreadableQuantity,
            "AB0104",
            "Quantity cannot be read",
            "The text is not a number followed by a known unit.",
        ),
        (
            Code::WrongDimension,
            "AB0105",
            "Wrong dimension",
            "The unit belongs to another dimension than the key takes, for example a length where a mass is needed.",
        ),
        (
            Code::OutOfRange,
            "AB0106",
            "Value out of range",
            "The value is outside the range that the key allows.",
        ),
        (
            Code::MissingKey,
            "AB0107",
            "Required key is missing",
            "A value that has no default is neither in the file nor in the bearing catalogue.",
        ),
        (
            Code::UnknownWord,
            "AB0108",
            "Unknown word",
            "The key takes one of a few words, and this is none of them.",
        ),
        (
            Code::Conflict,
            "AB0109",
            "Two values for one thing",
            "Two keys that exclude each other are both given.",
        ),
        (
            Code::UnusedKey,
            "AB0110",
            "Key without effect",
            "The key is known but has no effect with the other choices of the file, so it is refused instead of ignored.",
        ),
        (
            Code::UnknownFormat,
            "AB0111",
            "Unknown file format",
            "The first key of an input file names its format and version; this one is missing or not known.",
        ),
        (
            Code::NotBuilt,
            "AB0112",
            "Not built yet",
            "The thing asked for is planned, but this version does not have it.",
        ),
        (
            Code::UnreadableSet,
            "AB0113",
            "Override cannot be read",
            "An override on the command line is not of the form path=value.",
        ),
        (
            Code::TableOrder,
            "AB0114",
            "Rows out of order",
            "The first value of a table rises from row to row; this one does not, or what must rise with it does not.",
        ),
        (
            Code::UnknownBearing,
            "AB0201",
            "Unknown bearing",
            "The bearing is not in the catalogue; its dimensions can be given in the file instead.",
        ),
        (
            Code::BallsDoNotFit,
            "AB0202",
            "Balls do not fit",
            "The balls overlap when they are spaced evenly on the pitch circle.",
        ),
        (
            Code::BearingGeometry,
            "AB0203",
            "Impossible bearing geometry",
            "The diameters of the bearing contradict each other.",
        ),
        (
            Code::ClearanceTooLarge,
            "AB0204",
            "Air clearance too large",
            "The radial air clearance is not smaller than the radius of the bore, so there is no rotor left.",
        ),
        (
            Code::ContactAtStart,
            "AB0205",
            "Contact at the start",
            "The levitated rotor would already touch the inner race before the drop.",
        ),
        (
            Code::OutputInterval,
            "AB0206",
            "Run shorter than the output interval",
            "The output interval is longer than the run, so there would be no history.",
        ),
        (
            Code::TooManyRows,
            "AB0207",
            "Too many rows of output",
            "The history of the run would not fit into memory; how many rows do depends on the number of balls.",
        ),
        (
            Code::NoLawData,
            "AB0208",
            "No data for the law",
            "A law of friction or viscosity has no numbers for this bearing, lubrication or temperature; none are invented.",
        ),
        (
            Code::CreatesEnergy,
            "AB0209",
            "Loss that would create energy",
            "A loss must take energy out of the bearing whatever its speed and acceleration; this one would put some in.",
        ),
        (
            Code::Impossible,
            "AB0211",
            "Motion that cannot be",
            "What is asked for has no answer in the model, for example a step of speed on balls that always roll.",
        ),
        (
            Code::NotModelled,
            "AB0212",
            "Not modelled yet",
            "The key or the bearing is of something that no system describes yet; it is never computed as something else.",
        ),
        (
            Code::MeasurementInstead,
            "AB0213",
            "Measurement instead of a scenario",
            "The file holds measured values; the commands take a scenario that names it.",
        ),
        (
            Code::OutputExists,
            "AB0301",
            "Output folder exists",
            "The run directory exists already; results are never written over others.",
        ),
        (
            Code::OutputFailed,
            "AB0302",
            "Output cannot be written",
            "The operating system refuses to write a result file, for example because the disk is full.",
        ),
        (
            Code::MeasurementUnreadable,
            "AB0303",
            "Measurement file cannot be read",
            "The file is missing, empty, damaged beyond reading, or of a format that is not known.",
        ),
        (
            Code::UnknownChannel,
            "AB0304",
            "No such channel",
            "The measurement file has no channel of this name, or one without numbers.",
        ),
        (
            Code::ChannelClock,
            "AB0305",
            "Clock of a channel",
            "The times of a channel are not known, do not rise, or are not evenly spaced.",
        ),
        (
            Code::ChannelUnit,
            "AB0306",
            "Unit of a channel",
            "A channel has no unit, or one of another dimension than what is computed from it.",
        ),
        (
            Code::OutputPlace,
            "AB0307",
            "No place for results",
            "Nothing can be made at the path that was given: a part of it is no folder, or may not be written.",
        ),
        (
            Code::CaseDamaged,
            "AB0310",
            "Damaged case file",
            "A file of cases is cut off, empty or wrong in itself, so that what it would compare is not compared.",
        ),
        (
            Code::UnknownQuantity,
            "AB0340",
            "Limit of no such result",
            "A limit names a result that a run of this file does not have, or one that is not a single number, or one whose key is not given.",
        ),
        (
            Code::DuplicateBearing,
            "AB0401",
            "Bearing named twice",
            "A file of bearings has two of one name, so that a scenario could not say which it means.",
        ),
        (
            Code::RatingContradictsBalls,
            "AB0402",
            "Load rating contradicts the balls",
            "The static load rating is absurd for bearings with such balls: a digit or a unit is wrong.",
        ),
        (
            Code::NoSuchNode,
            "AB2000",
            "No such place on the rotor",
            "A part sits at a node or housing that the file does not name, or at a position beside the shaft.",
        ),
        (
            Code::RotorGeometry,
            "AB2001",
            "Impossible rotor geometry",
            "Pieces of shaft fill the same place, leave a gap, or have a bore as large as themselves.",
        ),
        (
            Code::UnknownMaterial,
            "AB2002",
            "Unknown material",
            "A piece of shaft is of a material that is neither known by name nor given in the file.",
        ),
        (
            Code::TooManyModes,
            "AB2003",
            "More modes than there are",
            "More modes are asked for than the rotor has that oscillate; more elements give more.",
        ),
        (
            Code::NotHeld,
            "AB2004",
            "Rotor without support",
            "The supports leave a motion of the rotor free, so it has no position at rest.",
        ),
        (
            Code::ImportFormat,
            "AB2005",
            "Not a rotor that can be imported",
            "The file is not of a program and version whose rotors are understood.",
        ),
        (
            Code::SectionTable,
            "AB2006",
            "Table of sections cannot be read",
            "A table of sections lacks a column, a unit in its header, or a number in a row.",
        ),
        (
            Code::ControllerSize,
            "AB2070",
            "Controller of another size",
            "Matrices of a controller do not fit each other, or the sensors and magnets that are there.",
        ),
        (
            Code::ControllerTime,
            "AB2071",
            "Impossible time of a controller",
            "A delay, sampling period or computing time cannot be, or differs between controllers.",
        ),
        (
            Code::ControllerFilter,
            "AB2072",
            "Filter that cannot be built",
            "Coefficients of a filter or a matrix cannot be read, or ask for a filter without bound at high frequency.",
        ),
        (
            Code::MagnetValues,
            "AB2073",
            "Values of a magnet contradict each other",
            "Stiffnesses, gap, bias and largest current of a magnet cannot all be true.",
        ),
        (
            Code::UnstableLevitation,
            "AB2074",
            "Unstable levitation",
            "The closed loop of rotor, magnets and controller has an eigenvalue that grows.",
        ),
        (
            Code::ZeroStaticStiffness,
            "AB2075",
            "Zero static stiffness",
            "The closed loop holds the rotor nowhere: an eigenvalue is zero.",
        ),
        (
            Code::CurrentLimit,
            "AB2076",
            "Magnets too weak for the weight",
            "The coils cannot carry the control current that holds the rotor at rest.",
        ),
        (
            Code::LevitationParts,
            "AB2077",
            "Magnet, sensor and controller do not fit",
            "A magnet has no sensor or controller, or two, or one of them belongs to no magnet.",
        ),
        (
            Code::StartBeyondLimit,
            "AB2078",
            "Start beyond a limit of the magnets",
            "Static part and unbalance amplitude of a coil current, a voltage or a displacement together exceed its limit.",
        ),
        (
            Code::StudyScenario,
            "AB2200",
            "Scenario that no study can run",
            "A study runs a scenario of single runs many times; this one repeats or varies itself, or reads a measurement.",
        ),
        (
            Code::StudyDesign,
            "AB2201",
            "Impossible design",
            "A design is too large, has no members, or cannot be extended.",
        ),
        (
            Code::StudyCorrelation,
            "AB2202",
            "Correlated inputs that cannot be",
            "Effects and indices belong to independent inputs, or the coefficients contradict each other.",
        ),
        (
            Code::StudyChanged,
            "AB2203",
            "Another study has this directory",
            "The study, its scenario or the version of the program differs from that which the directory was begun with.",
        ),
        (
            Code::StudyInUse,
            "AB2204",
            "Study in use",
            "Another process is working on this study.",
        ),
        (
            Code::StudyDamaged,
            "AB2205",
            "Damaged study directory",
            "A file of members cannot be read, or is not of this study.",
        ),
    ];

    /// Every code, in the order of its number.
    pub fn all() -> impl Iterator<Item = Code> {
        Code::TABLE.iter().map(|row| row.0)
    }

    fn row(self) -> &'static (Code, &'static str, &'static str, &'static str) {
        let position = self as usize;
        &Code::TABLE[position]
    }

    /// The printed form, such as `AB0103`.
    pub fn text(self) -> &'static str {
        self.row().1
    }

    /// A short title.
    pub fn title(self) -> &'static str {
        self.row().2
    }

    /// One sentence that explains it.
    pub fn sentence(self) -> &'static str {
        self.row().3
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text())
    }
}
