//! `cargo xtask python`: builds, installs and tests the Python module in an environment of its own,
//! `target/python`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use anyhow::{Context, Result, bail};

use crate::ci::Outcome;
use crate::workspace::{self, entries, succeed, target_folder};

/// Packages to build and test the module with.
const PACKAGES: &[&str] = &["maturin>=1.9,<2", "pytest", "mypy", "networkx", "gymnasium"];

/// MDP 3.6 uses names that later versions of numpy dropped, and this one has wheels for Python 3.9
/// to 3.11.
const WITH_MDP: &[&str] = &["MDP==3.6", "numpy==1.23.5", "setuptools<60"];

/// Packages to use where those cannot be installed. The comparison with MDP is then skipped.
const WITHOUT_MDP: &[&str] = &["numpy"];

/// Folder of the crate.
const CRATE: &str = "crates/python";

/// Builds the wheel in release, installs it and runs its tests, if Python and its packages are
/// available.
///
/// # Errors
/// If a step fails for another reason than that they are missing.
pub(crate) fn check() -> Result<Outcome> {
    let Some(system) = system_python() else {
        let why = "there is no Python 3.9 or newer with the module venv (PYTHON names another)";
        return Ok(Outcome::Missing(why.to_owned()));
    };
    let folder = target_folder()?.join("python");
    let environment = Environment { folder };
    if !environment.program("maturin").exists() && !environment.make(&system)? {
        let why = "the packages it is built and tested with cannot be installed";
        return Ok(Outcome::Missing(why.to_owned()));
    }
    let wheel = environment.wheel()?;
    let mut install = environment.python();
    install.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--no-deps",
        "--force-reinstall",
    ]);
    succeed(install.arg(wheel))?;
    let mut tests = environment.python();
    tests.args(["-m", "pytest", "-q", "-ra", CRATE]);
    succeed(tests.current_dir(workspace::root()))?;
    Ok(Outcome::Passed)
}

/// Returns the first Python that can make an environment.
pub(crate) fn system_python() -> Option<PathBuf> {
    let named = env::var_os("PYTHON").map(PathBuf::from);
    let usual = ["python3", "python"].map(PathBuf::from);
    let mut all = named.into_iter().chain(usual);
    all.find(|python| {
        let mut probe = Command::new(python);
        probe.args([
            "-c",
            "import sys, venv, ensurepip; assert sys.version_info >= (3, 9)",
        ]);
        probe.output().is_ok_and(|output| output.status.success())
    })
}

/// A Python with the packages that are needed, apart from those of the system.
pub(crate) struct Environment {
    pub(crate) folder: PathBuf,
}

impl Environment {
    fn program(&self, name: &str) -> PathBuf {
        let (programs, suffix) = match cfg!(windows) {
            true => ("Scripts", ".exe"),
            false => ("bin", ""),
        };
        self.folder.join(programs).join(format!("{name}{suffix}"))
    }

    pub(crate) fn python(&self) -> Command {
        Command::new(self.program("python"))
    }

    /// Makes the environment again, and returns whether all required packages could be installed.
    fn make(&self, system: &Path) -> Result<bool> {
        self.clear(system)?;
        if self.install(WITH_MDP).is_err() {
            eprintln!("MDP cannot be installed for this Python: it is not compared with");
            if self.install(WITHOUT_MDP).is_err() {
                return Ok(false);
            }
        }
        // Last, because an environment with maturin counts as complete.
        Ok(self.install(PACKAGES).is_ok())
    }

    /// Makes the environment again, without packages.
    pub(crate) fn clear(&self, system: &Path) -> Result<()> {
        let mut make = Command::new(system);
        succeed(make.args(["-m", "venv", "--clear"]).arg(&self.folder))
    }

    pub(crate) fn install(&self, packages: &[&str]) -> Result<()> {
        let mut install = self.python();
        install.args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
        ]);
        succeed(install.args(packages))
    }

    /// Builds the wheel and returns its path.
    fn wheel(&self) -> Result<PathBuf> {
        let wheels = self.folder.join("wheels");
        if wheels.exists() {
            fs::remove_dir_all(&wheels).context("cannot remove the wheels built before")?;
        }
        let manifest = workspace::root().join(CRATE).join("Cargo.toml");
        let mut build = Command::new(self.program("maturin"));
        build.args(["build", "--release", "--quiet", "--manifest-path"]);
        build.arg(manifest).arg("--out").arg(&wheels);
        build.arg("--interpreter").arg(self.program("python"));
        succeed(&mut build)?;
        match &entries(&wheels)?[..] {
            [wheel] => Ok(wheel.clone()),
            found => bail!("maturin made {} wheels where one was expected", found.len()),
        }
    }
}
