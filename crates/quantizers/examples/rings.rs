//! Two rings of points, learnt in passing, drawn as SVG:
//! `cargo run --release -p tolman-quantizers --example rings > rings.svg`

use core::error::Error;
use core::f64::consts::TAU;
use std::io::Write as _;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_quantizers::{Gng, GngConfig, Quantizer};

fn main() -> Result<(), Box<dyn Error>> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut config = GngConfig::fritzke();
    config.max_units = 60;
    let mut gng = Gng::<f64>::new(2, config)?;
    for _ in 0..30_000 {
        let (x, y, radius) = if rng.random_bool(0.5) {
            (-0.6, 0.0, 1.0)
        } else {
            (0.9, 0.3, 0.3)
        };
        let (angle, far): (f64, f64) = (rng.random_range(0.0..TAU), rng.random_range(0.95..1.05));
        let radius = radius * far;
        gng.observe(&[x + radius * angle.cos(), y + radius * angle.sin()])?;
    }

    let network = gng.network();
    let clusters = network.clusters();
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1.8 -1.2 3 2.4" width="600">"#
    )?;
    writeln!(
        out,
        "<!-- {} units in {} clusters -->",
        network.len(),
        clusters.count()
    )?;
    for edge in network.edges() {
        let [a, b] = [edge.ends.0, edge.ends.1].map(|id| network.prototype(id));
        let (a, b): (Vec<_>, Vec<_>) = (a?.collect(), b?.collect());
        let (x1, y1, x2, y2) = (a[0], -a[1], b[0], -b[1]);
        writeln!(
            out,
            r##"<path d="M{x1:.3} {y1:.3}L{x2:.3} {y2:.3}" stroke="#888" stroke-width="0.01"/>"##
        )?;
    }
    for (id, label) in clusters.iter() {
        let at: Vec<f64> = network.prototype(id)?.collect();
        let hue = label * 137 % 360;
        writeln!(
            out,
            r#"<circle cx="{:.3}" cy="{:.3}" r="0.025" fill="hsl({hue} 70% 45%)"/>"#,
            at[0], -at[1]
        )?;
    }
    writeln!(out, "</svg>")?;
    Ok(())
}
