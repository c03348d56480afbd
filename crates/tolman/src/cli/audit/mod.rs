//! `tolman audit`: which loop closures of a pose graph are right.

mod certificates;
mod page;
mod told;

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use tolman_formats::{G2o, G2oEdge};
use tolman_maps::audit::{
    Audit, AuditConfig, AuditedClosure, ClosureVerdict, SigmaScale, audit, supported_graph, verify,
};
use tolman_papers::real::GraphFile;

use super::bar::busy;
use super::outputs::{self, Output};
use super::{Failure, OrBadInput, Result, file};
use certificates::CertificateFile;

/// Finds which loop closures of a pose graph are right, wrong or undecided; exits 1 if one is wrong
#[derive(clap::Args)]
#[command(after_help = "\
A closure gets one of three verdicts:
  supported   independent cycles agree with it
  refuted     a cycle is off by more than five standard deviations; the certificate names it, so it can be measured again
  undecided   neither, with the reason

The folder gets audit.html, cleaned.g2o (without the refuted closures), certificates.json and verdicts.csv. docs/audit.md has more.

Example:
  tolman audit mazes/graphs/rooms.g2o --out audited # exits 1
  tolman audit mazes/graphs/rooms.g2o --out audited --verify")]
pub(super) struct Arguments {
    /// Pose graph in g2o format (VERTEX_SE2, EDGE_SE2), plain or gzipped
    graph: PathBuf,
    /// Factor for every stated standard deviation, or `auto` to estimate it from the graph's own
    /// short cycles
    #[arg(long, value_name = "S|auto", default_value = "1", value_parser = scale)]
    sigma_scale: Scale,
    /// Check the certificates in the folder instead of making them; exits 1 if one does not hold
    #[arg(long)]
    verify: bool,
    /// Folder for the results [default: results/audit/NAME]
    #[arg(long, value_name = "DIR", value_parser = outputs::folder(FILES))]
    out: Option<Output>,
    /// Leave undecided closures out of cleaned.g2o as well as refuted ones
    #[arg(long, conflicts_with = "verify")]
    strict: bool,
}

#[derive(Clone, Copy)]
enum Scale {
    Auto,
    By(f64),
}

fn scale(text: &str) -> Result<Scale, String> {
    if text == "auto" {
        return Ok(Scale::Auto);
    }
    let scale = text.parse::<f64>().ok();
    scale
        .filter(|scale| *scale > 0.0 && scale.is_finite())
        .map(Scale::By)
        .ok_or_else(|| "give a positive number, or auto".to_owned())
}

/// A graph and its audit.
struct Audited<'a> {
    name: String,
    file: &'a GraphFile,
    config: AuditConfig,
    estimate: Option<SigmaScale>,
    audit: Audit,
}

/// Names of the files in the folder.
const FILES: &[&str] = &[
    certificates::NAME,
    "verdicts.csv",
    "cleaned.g2o",
    "audit.html",
];

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let file = GraphFile::read(&arguments.graph).or_bad_input()?;
    told::left_out(&arguments.graph, &file.file);
    let folder = arguments.folder();
    if arguments.verify {
        return check(&file, &arguments.graph, &folder, out);
    }
    if arguments.out.is_none() {
        outputs::writes("out", &folder)?;
    }
    let audited = arguments.audited(&file)?;
    audited.tell(out)?;
    arguments.write(&audited, &folder)?;
    writeln!(out, "written to {}", folder.display())?;
    let refuted = audited.audit.count(ClosureVerdict::is_refuted);
    match refuted {
        0 => Ok(()),
        _ => Err(Failure::Failed(anyhow!(
            "{}: {refuted} of {} closures {} refuted; {} is without {}",
            audited.name,
            audited.audit.closures.len(),
            if refuted == 1 { "is" } else { "are" },
            folder.join("cleaned.g2o").display(),
            if refuted == 1 { "it" } else { "them" },
        ))),
    }
}

impl Arguments {
    fn folder(&self) -> Output {
        self.out.clone().unwrap_or_else(|| {
            let name = self.graph.file_name().unwrap_or_default().to_string_lossy();
            let name = name.trim_end_matches(".gz").trim_end_matches(".g2o");
            Output::folder(Path::new("results").join("audit").join(name), FILES)
        })
    }

    fn audited<'a>(&self, file: &'a GraphFile) -> Result<Audited<'a>> {
        let estimate = SigmaScale::estimate(&file.graph).or_bad_input()?;
        let scale = match self.sigma_scale {
            Scale::By(scale) => scale,
            Scale::Auto => estimate.map_or(1.0, |estimate| estimate.scale()),
        };
        let mut config = AuditConfig::standard();
        config.sigma_scale = scale;
        let bar = busy("auditing", false);
        let audit = audit(&file.graph, &config).or_bad_input();
        bar.finish_and_clear();
        Ok(Audited {
            name: self.graph.display().to_string(),
            file,
            config,
            estimate,
            audit: audit?,
        })
    }

    fn write(&self, audited: &Audited<'_>, folder: &Path) -> Result {
        file::make_folder(folder, "name another folder by --out")?;
        let certificates = CertificateFile::of(audited);
        let json = serde_json::to_string(&certificates)?;
        file::write(&folder.join(certificates::NAME), json + "\n")?;
        file::write(&folder.join("verdicts.csv"), told::csv(audited))?;
        file::write(
            &folder.join("cleaned.g2o"),
            audited.cleaned(self.strict).text(),
        )?;
        let laid_out = supported_graph(&audited.file.graph, &audited.config, &audited.audit);
        file::write(&folder.join("audit.html"), page::html(audited, &laid_out))
    }
}

impl Audited<'_> {
    /// Returns a closure as its file has it.
    fn edge(&self, closure: &AuditedClosure) -> &G2oEdge {
        &self.file.file.edges[closure.edge as usize]
    }

    /// Returns the graph without refuted closures; without undecided ones too if `strict`.
    fn cleaned(&self, strict: bool) -> G2o {
        let goes = |verdict: &ClosureVerdict| match strict {
            true => !verdict.is_supported(),
            false => verdict.is_refuted(),
        };
        let mut stays = vec![true; self.file.file.edges.len()];
        for closure in &self.audit.closures {
            stays[closure.edge as usize] = !goes(&closure.verdict);
        }
        let mut cleaned = self.file.file.clone();
        let mut stays = stays.into_iter();
        cleaned.edges.retain(|_| stays.next().unwrap_or(true));
        cleaned
    }
}

/// Measures the certificates in a folder again and reports which hold.
fn check(file: &GraphFile, graph: &Path, folder: &Path, out: &mut dyn Write) -> Result {
    let path = folder.join(certificates::NAME);
    let repair = "audit without --verify first, or name the folder by --out";
    let text = file::read(&path, repair)?;
    let certificates = CertificateFile::read(&text)
        .with_context(|| path.display().to_string())
        .or_bad_input()?;
    let (audit, config) = certificates
        .audit(file)
        .map_err(|error| Failure::Failed(anyhow!("{}: {error}", path.display())))?;
    verify(&file.graph, &config, &audit).map_err(|error| {
        Failure::Failed(anyhow!(
            "{}: {}",
            path.display(),
            told::by_line(&error, file)
        ))
    })?;
    Ok(writeln!(
        out,
        "{}: all certificates hold: {} refuted, {} supported",
        graph.display(),
        audit.count(ClosureVerdict::is_refuted),
        audit.count(ClosureVerdict::is_supported),
    )?)
}
