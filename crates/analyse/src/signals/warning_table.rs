//! Warnings of measured signals: the sentences of their estimators, each with what it concerns.

problem::warnings! {
    /// Of measured signals.
    pub enum SignalsWarning {
        File { about: text, note: words } "AB1040" Uncertain ("{about}: {note}.");
        Channel { about: text, note: words } "AB1041" Uncertain ("{about}: {note}.");
        Refused { what: text, place: words, why: words } "AB1042" Invalid ("No {what} from {place}: {why}.");
        Estimate { about: text, note: words } "AB1043" Uncertain ("{about}: {note}.");
        MarksPerRevolution { about: text, note: words } "AB1044" Invalid ("{about}: {note}.");
        Cage { about: text, note: words } "AB1045" Uncertain ("{about}: {note}.");
        SpeedChannel { about: text, note: words } "AB1120" Uncertain ("{about}: {note}.");
        LargestSpeed { about: text, note: words } "AB1121" Uncertain ("{about}: {note}.");
        SteadyCurve { about: text, note: words } "AB1122" Uncertain ("{about}: {note}.");
        Zero { about: text, note: words } "AB1127" Invalid ("{about}: {note}.");
        Ringing { about: text, note: words } "AB1128" Invalid ("{about}: {note}.");
    }
}
