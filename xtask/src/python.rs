//! `cargo xtask python`: builds, installs and tests the Python modules in environments of their
//! own, `target/python` and `target/python-old`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use anyhow::{Context, Result, bail};

use crate::ci::Outcome;
use crate::workspace::{self, entries, succeed, target_folder};

/// Packages to build and test the modules with, each in its newest release. A kernel and its client
/// run the notebooks.
const PACKAGES: &[&str] = &[
    "maturin>=1.9,<2",
    "pytest",
    "scikit-learn",
    "networkx",
    "gymnasium",
    "pandas",
    "polars",
    "pyarrow",
    "matplotlib",
    "aalpy",
    "ratinabox",
    "nbclient",
    "ipykernel",
    "mypy",
    "pyright[nodejs]",
];

/// The oldest scikit-learn that is supported. MDP 3.6 uses names that later versions of numpy
/// dropped, and this one has wheels for Python 3.9 to 3.11.
const OLD: &[&str] = &[
    "scikit-learn==1.3.2",
    "MDP==3.6",
    "numpy==1.23.5",
    "setuptools<60",
    "pytest",
];

/// The packages, the smaller first; each needs those before it.
const CRATES: [&str; 2] = ["crates/python-quantizers", "crates/python"];

/// Builds the wheels in release, installs them and runs their tests, if Python and its packages are
/// available: all with the newest packages, those of the quantizers also with old ones.
///
/// # Errors
/// If a step fails for another reason than that they are missing.
pub(crate) fn check() -> Result<Outcome> {
    let Some(system) = system_python() else {
        let why = "there is no Python 3.9 or newer with the module venv (PYTHON names another)";
        return Ok(Outcome::Missing(why.to_owned()));
    };
    let target = target_folder()?;
    let environment = Environment {
        folder: target.join("python"),
    };
    if !environment.program("maturin").exists() && !environment.make(&system, PACKAGES)? {
        let why = "the packages it is built and tested with cannot be installed";
        return Ok(Outcome::Missing(why.to_owned()));
    }
    let mut wheels = Vec::new();
    for folder in CRATES {
        let wheel = environment.wheel(folder)?;
        environment.test(folder, &wheel)?;
        wheels.push(wheel);
    }
    let old = Environment {
        folder: target.join("python-old"),
    };
    if !old.program("pytest").exists() && !old.make(&system, OLD)? {
        eprintln!(
            "MDP cannot be installed for this Python: neither it nor an old scikit-learn is tried"
        );
        return Ok(Outcome::Passed);
    }
    old.test(CRATES[0], &wheels[0])?;
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

    /// Makes the environment again, and returns whether the packages could be installed.
    fn make(&self, system: &Path, packages: &[&str]) -> Result<bool> {
        self.clear(system)?;
        Ok(self.install(packages).is_ok())
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

    /// Installs a wheel and runs the tests of its crate.
    fn test(&self, folder: &str, wheel: &Path) -> Result<()> {
        let mut install = self.python();
        install.args(["-m", "pip", "install", "--quiet", "--no-deps"]);
        succeed(install.arg("--force-reinstall").arg(wheel))?;
        let mut tests = self.python();
        tests.args(["-m", "pytest", "-q", "-ra", folder]);
        succeed(tests.current_dir(workspace::root()))
    }

    /// Builds the wheel of a crate and returns its path.
    fn wheel(&self, folder: &str) -> Result<PathBuf> {
        let root = workspace::root();
        let wheels = self.folder.join("wheels").join(folder);
        if wheels.exists() {
            fs::remove_dir_all(&wheels).context("cannot remove the wheels built before")?;
        }
        let mut build = Command::new(self.program("maturin"));
        build.args(["build", "--release", "--quiet", "--manifest-path"]);
        build.arg(root.join(folder).join("Cargo.toml"));
        build.arg("--out").arg(&wheels);
        build.arg("--interpreter").arg(self.program("python"));
        succeed(&mut build)?;
        match &entries(&wheels)?[..] {
            [wheel] => Ok(wheel.clone()),
            found => bail!("maturin made {} wheels where one was expected", found.len()),
        }
    }
}
