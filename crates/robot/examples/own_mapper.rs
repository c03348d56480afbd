//! A mapper of your own: it learns the doors of a corridor from what a robot on a rail has logged.
#![expect(clippy::print_stdout, reason = "its map is its result")]

use core::convert::Infallible;

use tolman_geom::Point;
use tolman_robot::{MapPlace, MapView, Mapper};

/// A time step: how far the robot rolled, m, and whether a door stands open beside it.
struct Rolled(f64, bool);

#[derive(Default)]
struct Doors {
    at: f64,
    doors: Vec<f64>,
}

impl Mapper for Doors {
    type Observation = Rolled;
    type Error = Infallible;

    fn observe(&mut self, seen: &Rolled) -> Result<(), Infallible> {
        let Rolled(way, door) = *seen;
        self.at += way;
        // A door within half a metre of one that it knows is the same.
        if door && self.doors.iter().all(|door| (door - self.at).abs() > 0.5) {
            self.doors.push(self.at);
        }
        Ok(())
    }

    fn map(&self) -> MapView {
        let place = |(id, &x): (u32, &f64)| MapPlace {
            id,
            position: Some(Point::new(x, 0.0)),
            landmark: None,
        };
        let places: Vec<MapPlace> = (0..).zip(&self.doors).map(place).collect();
        MapView {
            places,
            links: Vec::new(),
            ..MapView::default()
        }
    }
}

fn main() -> Result<(), Infallible> {
    let mut mapper = Doors::default();
    for step in 0..20 {
        let way = if step < 10 { 0.9 } else { -0.9 };
        let door = matches!(step, 2 | 7 | 11 | 16);
        mapper.observe(&Rolled(way, door))?;
    }
    let map = mapper.map();
    for MapPlace { id, position, .. } in &map.places {
        println!("door {id} at {:.1} m", position.map_or(f64::NAN, |at| at.x));
    }
    assert_eq!(map.places.len(), 2, "each was met going and coming");
    Ok(())
}
