//! The kinds of wrong input, each with its stable code. What each means and what to do stands in the book's page of codes.

use std::fmt;

macro_rules! codes {
    ($($kind:ident $code:literal)*) => {
        /// What kind of wrong input it is. The printed form (`AB0103`) is stable: a number is never used again for another thing.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $(#[doc = $code] $kind,)*
        }

        impl Code {
            /// Every code, in the order of its number.
            pub const ALL: &[Code] = &[$(Code::$kind),*];

            /// The printed form, such as `AB0103`.
            pub fn text(self) -> &'static str {
                match self {
                    $(Code::$kind => $code,)*
                }
            }
        }
    };
}

codes! {
    FileMissing "AB0001"
    FileIsFolder "AB0002"
    FileNotUtf8 "AB0003"
    FileEmpty "AB0004"
    FileTooLarge "AB0005"
    FileUnreadable "AB0006"
    Syntax "AB0100"
    UnknownKey "AB0101"
    WrongType "AB0102"
    BareNumber "AB0103"
    UnreadableQuantity "AB0104"
    WrongDimension "AB0105"
    OutOfRange "AB0106"
    MissingKey "AB0107"
    UnknownWord "AB0108"
    Conflict "AB0109"
    UnusedKey "AB0110"
    UnknownFormat "AB0111"
    NotBuilt "AB0112"
    UnreadableSet "AB0113"
    TableOrder "AB0114"
    UnknownBearing "AB0201"
    BallsDoNotFit "AB0202"
    BearingGeometry "AB0203"
    ClearanceTooLarge "AB0204"
    ContactAtStart "AB0205"
    OutputInterval "AB0206"
    TooManyRows "AB0207"
    NoLawData "AB0208"
    CreatesEnergy "AB0209"
    Impossible "AB0211"
    NotModelled "AB0212"
    MeasurementInstead "AB0213"
    OutputExists "AB0301"
    OutputFailed "AB0302"
    MeasurementUnreadable "AB0303"
    UnknownChannel "AB0304"
    ChannelClock "AB0305"
    ChannelUnit "AB0306"
    OutputPlace "AB0307"
    FolderInUse "AB0308"
    PortInUse "AB0309"
    CaseDamaged "AB0310"
    UnknownQuantity "AB0340"
    DuplicateBearing "AB0401"
    RatingContradictsBalls "AB0402"
    NoSuchNode "AB2000"
    RotorGeometry "AB2001"
    UnknownMaterial "AB2002"
    TooManyModes "AB2003"
    NotHeld "AB2004"
    ImportFormat "AB2005"
    SectionTable "AB2006"
    ControllerSize "AB2070"
    ControllerTime "AB2071"
    ControllerFilter "AB2072"
    MagnetValues "AB2073"
    UnstableLevitation "AB2074"
    ZeroStaticStiffness "AB2075"
    CurrentLimit "AB2076"
    LevitationParts "AB2077"
    StartBeyondLimit "AB2078"
    StudyScenario "AB2200"
    StudyDesign "AB2201"
    StudyCorrelation "AB2202"
    StudyChanged "AB2203"
    StudyInUse "AB2204"
    StudyDamaged "AB2205"
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
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text())
    }
}
