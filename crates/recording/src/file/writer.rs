//! Writing of a measurement file, whatever its format.

use crate::FileError;

/// A measurement file that is being written, piece by piece.
///
/// The file carries its name only after [`Writer::finish`]; until then a name beside it is used, and a writer that is
/// dropped leaves nothing.
pub trait Writer {
    /// Appends values: one slice for each channel, in their order; slices of channels with one clock have one length.
    fn append(&mut self, values: &[&[f64]]) -> Result<(), FileError>;

    /// Completes the file and gives it its name.
    fn finish(self: Box<Self>) -> Result<(), FileError>;
}
