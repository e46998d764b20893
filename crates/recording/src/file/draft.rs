//! A file that carries its name only once it is whole.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::FileError;

/// A file under a temporary name beside its own; dropped unfinished it is removed.
#[derive(Debug)]
pub struct Draft {
    file: Option<BufWriter<File>>,
    path: PathBuf,
    temporary: PathBuf,
}

impl Draft {
    /// Starts the file that will be `path`.
    pub fn create(path: &Path) -> Result<Draft, FileError> {
        let Some(name) = path.file_name() else {
            return Err(FileError::new(path, "", "is no name of a file", ""));
        };
        let mut temporary = name.to_owned();
        temporary.push(format!(".{}.unfinished", std::process::id()));
        let temporary = path.with_file_name(temporary);
        let file = File::create(&temporary)
            .map_err(|e| FileError::new(&temporary, "", format!("cannot be written ({e})"), ""))?;
        Ok(Draft {
            file: Some(BufWriter::with_capacity(1 << 16, file)),
            path: path.to_owned(),
            temporary,
        })
    }

    /// The name that the file will carry.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// An error of the system as one of this file.
    pub fn error(&self, error: &io::Error) -> FileError {
        FileError::new(&self.path, "", format!("cannot be written ({error})"), "")
    }

    /// Completes the file on the disk and gives it its name, in place of whatever carried it before.
    pub fn finish(mut self) -> Result<(), FileError> {
        let Some(mut file) = self.file.take() else {
            return Ok(());
        };
        let done = file
            .flush()
            .and_then(|()| file.get_ref().sync_all())
            .and_then(|()| {
                drop(file);
                std::fs::rename(&self.temporary, &self.path)
            });
        done.map_err(|e| {
            let _ = std::fs::remove_file(&self.temporary);
            self.error(&e)
        })
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.as_mut().map_or(Ok(0), |file| file.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        if self.file.take().is_some() {
            let _ = std::fs::remove_file(&self.temporary);
        }
    }
}
