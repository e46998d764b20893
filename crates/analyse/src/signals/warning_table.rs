//! Warnings of measured signals: the sentences of their estimators, each with what it concerns.

problem::warnings! {
    /// Of measured signals.
    pub enum SignalsWarning {
        File { about: text, note: note } "AB1040" Uncertain (note "{}: {}.", about.as_str(), note);
        Channel { about: text, note: note } "AB1041" Uncertain (note "{}: {}.", about.as_str(), note);
        Refused { what: text, place: words, why: note } "AB1042" Invalid (note "No {} from {}: {}.", what.as_str(), place, why);
        Estimate { about: text, note: note } "AB1043" Uncertain (note "{}: {}.", about.as_str(), note);
        MarksPerRevolution { about: text, note: note } "AB1044" Invalid (note "{}: {}.", about.as_str(), note);
        Cage { about: text, note: note } "AB1045" Uncertain (note "{}: {}.", about.as_str(), note);
        SpeedChannel { about: text, note: note } "AB1120" Uncertain (note "{}: {}.", about.as_str(), note);
        LargestSpeed { about: text, note: note } "AB1121" Uncertain (note "{}: {}.", about.as_str(), note);
        SteadyCurve { about: text, note: note } "AB1122" Uncertain (note "{}: {}.", about.as_str(), note);
        Zero { about: text, note: note } "AB1127" Invalid (note "{}: {}.", about.as_str(), note);
        Ringing { about: text, note: note } "AB1128" Invalid (note "{}: {}.", about.as_str(), note);
    }
}
