//! Checks that each published package builds and passes its tests without the workspace beside it.

use core::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::workspace::{cargo, metadata, read, root, rust_files, succeed, target_folder};

/// The package that is packed with every change: it depends on no other package, and its tests take
/// seconds.
const ONE: &str = "tolman-stats";

/// A published member of the workspace.
pub(crate) struct Package {
    pub(crate) name: String,
    pub(crate) version: String,
    /// Folder of the package in the workspace.
    folder: PathBuf,
    /// Names of the packages that it needs, to be built or to be tested.
    needs: Vec<String>,
}

impl Package {
    /// Reads cargo's metadata of a member; `None` if it is not published.
    fn of(member: &Value) -> Option<Self> {
        member["publish"].is_null().then_some(())?;
        let needs = member["dependencies"].as_array()?.iter();
        let needs = needs.filter_map(|need| need["name"].as_str());
        Some(Self {
            name: member["name"].as_str()?.to_owned(),
            version: member["version"].as_str()?.to_owned(),
            folder: Path::new(member["manifest_path"].as_str()?)
                .parent()?
                .to_owned(),
            needs: needs.map(str::to_owned).collect(),
        })
    }

    /// Returns the package's name in files.
    pub(crate) fn stem(&self) -> String {
        format!("{}-{}", self.name, self.version)
    }
}

/// Packs one package, and tests it. Of the others only looks that they include no file from outside
/// of their folder, which would not be packed.
///
/// # Errors
/// As [`all`].
pub(crate) fn one() -> Result<()> {
    let mut packages = published()?;
    for Package { name, folder, .. } in &packages {
        if let Some((file, path)) = included_from_outside(folder)? {
            bail!(
                "{} includes {path}, which is not packed with {name}: include it from the package's own folder",
                file.display()
            );
        }
    }
    packages.retain(|package| package.name == ONE);
    let folder = unpacked("package", &packages)?;
    succeed(&mut inside(&folder, "test --quiet --all-features")?)
}

/// Returns the first source file of a package that includes a file from outside of its folder, with
/// the path that it gives; `None` if there is none.
fn included_from_outside(package: &Path) -> Result<Option<(PathBuf, String)>> {
    for file in rust_files(package)? {
        let text = read(&file)?;
        let included = ["include_str!(\"", "include_bytes!(\""];
        let paths = included
            .iter()
            .flat_map(|macro_| text.split(macro_).skip(1));
        let depth = file.strip_prefix(package)?.components().count() - 1;
        let paths = paths.filter_map(|rest| rest.split('"').next());
        let up = |path: &str| path.split('/').take_while(|part| *part == "..").count();
        if let Some(path) = paths.into_iter().find(|path| up(path) > depth) {
            return Ok(Some((file.clone(), path.to_owned())));
        }
    }
    Ok(None)
}

/// Packs all packages, builds each by itself and tests them together.
///
/// # Errors
/// If one cannot be packed, lacks a file or a feature, or fails its tests.
pub(crate) fn all() -> Result<()> {
    let packages = published()?;
    let folder = unpacked("packages", &packages)?;
    for Package { name, .. } in &packages {
        // Built together, they would switch on each other's features.
        succeed(&mut inside(
            &folder,
            &format!("check --quiet --package {name}"),
        )?)?;
    }
    succeed(&mut inside(
        &folder,
        "test --quiet --workspace --all-features",
    )?)?;
    eprintln!("{} packages build and pass their tests", packages.len());
    Ok(())
}

/// Returns the published packages, each after those that it needs.
///
/// # Errors
/// If cargo cannot read a manifest, or packages need each other in a circle.
pub(crate) fn in_order() -> Result<Vec<Package>> {
    let mut left = published()?;
    let mut ordered: Vec<Package> = Vec::new();
    while !left.is_empty() {
        let waits = |package: &Package| {
            let mut others = left.iter().filter(|other| other.name != package.name);
            others.any(|other| package.needs.contains(&other.name))
        };
        let next = left.iter().position(|package| !waits(package));
        let next = next.with_context(|| {
            let names: Vec<&str> = left.iter().map(|package| &*package.name).collect();
            format!("these need each other in a circle: {}", names.join(", "))
        })?;
        ordered.push(left.remove(next));
    }
    Ok(ordered)
}

fn published() -> Result<Vec<Package>> {
    let metadata = metadata()?;
    let members = metadata["packages"].as_array();
    let members = members.context("`cargo metadata` names no packages")?;
    Ok(members.iter().filter_map(Package::of).collect())
}

/// Packs the packages and unpacks them into a workspace of their own. It has only the dependencies'
/// versions and the profiles of this one. Returns its folder.
fn unpacked(name: &str, packages: &[Package]) -> Result<PathBuf> {
    let mut pack = cargo("package --quiet --offline --no-verify --allow-dirty");
    for package in packages {
        pack.args(["--package", &package.name]);
    }
    succeed(&mut pack)?;
    let folder = target_folder()?.join("tmp").join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    for package in packages {
        let file = format!("package/{}.crate", package.stem());
        let mut unpack = Command::new("tar");
        // Packed files have one time for all, by which cargo takes changed ones for compiled.
        unpack.arg("-xzmf").arg(target_folder()?.join(file));
        succeed(unpack.arg("-C").arg(&folder))?;
    }
    fs::write(folder.join("Cargo.toml"), manifest(packages)?)?;
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock"))?;
    Ok(folder)
}

/// Returns the manifest of that workspace.
fn manifest(packages: &[Package]) -> Result<String> {
    let mut text = "[workspace]\nresolver = \"3\"\nmembers = [\"*-*.*.*\"]\n\n".to_owned();
    text.push_str("[patch.crates-io]\n");
    for package in packages {
        writeln!(
            text,
            "{} = {{ path = \"{}\" }}",
            package.name,
            package.stem()
        )?;
    }
    let own = read(&root().join("Cargo.toml"))?;
    let profiles = own.find("[profile.dev]");
    let profiles = profiles.context("the workspace has no [profile.dev]")?;
    Ok(text + "\n" + &own[profiles..])
}

/// Returns cargo in that workspace, which shares the compiled outside crates with this one.
fn inside(folder: &Path, arguments: &str) -> Result<Command> {
    let mut command = cargo(arguments);
    command.current_dir(folder).arg("--offline");
    command.arg("--target-dir").arg(target_folder()?);
    command.env("PROPTEST_RNG_SEED", "1");
    Ok(command)
}
