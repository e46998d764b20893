//! All tests of the crate but that of its memory, in one binary.

mod csv;
mod formats;
mod hdf5;
mod hdf5_damage;
mod heads;
mod mat4;
mod mat5;
mod parquet;
mod tables;
mod tdms;
mod uff;
mod wav;
