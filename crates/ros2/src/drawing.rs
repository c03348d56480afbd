//! The map as messages: an occupancy grid, and markers for places and ways.

use tolman_formats::{MapCell, RosMap};
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{Landmark, MapView};

use crate::messages::{Color, Header, Marker, MarkerArray, OccupancyGrid, Vector3};
use crate::sightings::position_of;

/// Kinds of `visualization_msgs/Marker`.
const LINE_LIST: i32 = 5;
const SPHERE_LIST: i32 = 7;

/// Returns a map as `nav_msgs/OccupancyGrid`.
pub(crate) fn occupancy(map: &RosMap, header: Header) -> OccupancyGrid {
    let value = |cell: &MapCell| match cell {
        MapCell::Unknown => -1,
        MapCell::Free => 0,
        MapCell::Occupied => 100,
    };
    OccupancyGrid {
        map_load_time: header.stamp,
        header,
        resolution: map.resolution as f32,
        width: map.width as u32,
        height: map.height as u32,
        origin: Pose::new(map.origin, Heading::from_radians(0.0)).into(),
        data: map.cells.iter().map(value).collect(),
    }
}

/// Returns the places and ways of a map, the goal in another colour. Balls are `size` m across.
pub(crate) fn markers(map: &MapView, header: &Header, size: f64) -> MarkerArray {
    let marker = |id, kind, size: f64, [r, g, b]: [f32; 3], points: Vec<Point>| Marker {
        header: header.clone(),
        ns: "tolman".to_owned(),
        id,
        kind,
        scale: Vector3 {
            x: size,
            y: size,
            z: size,
        },
        color: Color { r, g, b, a: 1.0 },
        points: points.into_iter().map(Vector3::from).collect(),
        ..Marker::default()
    };
    let of = |goal: bool| {
        let places = map.places.iter();
        let places = places.filter(|place| (place.landmark == Some(Landmark::Goal)) == goal);
        places.filter_map(|place| place.position).collect()
    };
    let ends = |index: usize| {
        let link = map.links.get(index)?;
        match map.ways.get(index) {
            Some(way) if way.len() > 1 => Some(way.clone()),
            _ => Some(vec![
                position_of(map, link.from)?,
                position_of(map, link.to)?,
            ]),
        }
    };
    let ways = (0..map.links.len()).filter_map(ends);
    let pairs = ways.flat_map(|way| {
        let pairs: Vec<Point> = way.windows(2).flat_map(<[Point]>::to_vec).collect();
        pairs
    });
    MarkerArray {
        markers: vec![
            marker(0, LINE_LIST, 0.2 * size, [0.3, 0.5, 0.9], pairs.collect()),
            marker(1, SPHERE_LIST, size, [0.1, 0.3, 0.8], of(false)),
            marker(2, SPHERE_LIST, size, [0.9, 0.4, 0.1], of(true)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use tolman_robot::{MapLink, MapPlace};

    use super::*;

    #[test]
    fn a_way_becomes_lines() {
        let place = |id, x, landmark| MapPlace {
            id,
            position: Some(Point::new(x, 0.0)),
            landmark,
        };
        let map = MapView {
            places: vec![place(0, 0.0, None), place(1, 1.0, Some(Landmark::Goal))],
            links: MapLink::both_ways(0, 1).to_vec(),
            ways: vec![
                [0.0, 0.5, 1.0].map(|x| Point::new(x, 0.0)).to_vec(),
                Vec::new(),
            ],
            ..MapView::default()
        };
        let drawn = markers(&map, &Header::default(), 0.1);
        let lengths: Vec<usize> = drawn
            .markers
            .iter()
            .map(|marker| marker.points.len())
            .collect();
        assert_eq!(lengths, [4 + 2, 1, 1]);
    }

    #[test]
    fn unknown_floor_is_minus_one() {
        let map = RosMap {
            width: 3,
            height: 1,
            resolution: 0.05,
            origin: Point::origin(),
            cells: vec![MapCell::Unknown, MapCell::Free, MapCell::Occupied],
        };
        assert_eq!(occupancy(&map, Header::default()).data, [-1, 0, 100]);
    }
}
