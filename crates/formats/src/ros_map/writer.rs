use super::{MapCell, RosMap};

/// Value of a free cell in the picture, as map_saver writes it.
const FREE: u8 = 254;
const UNKNOWN: u8 = 205;
const OCCUPIED: u8 = 0;

impl RosMap {
    /// Returns the YAML file of the map, whose picture is the file `image` beside it.
    #[must_use]
    pub fn yaml(&self, image: &str) -> String {
        let Self {
            resolution, origin, ..
        } = self;
        let (x, y) = (origin.x, origin.y);
        format!(
            "image: {image}\nresolution: {resolution}\norigin: [{x:.6}, {y:.6}, 0.000000]\nnegate: 0\noccupied_thresh: 0.65\n\
             free_thresh: 0.196\n"
        )
    }

    /// Returns the picture of the map as a binary PGM, its first row the northernmost. O(cells).
    #[must_use]
    pub fn pgm(&self) -> Vec<u8> {
        let mut bytes = format!("P5\n{} {}\n255\n", self.width, self.height).into_bytes();
        let shade = |cell: &MapCell| match cell {
            MapCell::Free => FREE,
            MapCell::Occupied => OCCUPIED,
            MapCell::Unknown => UNKNOWN,
        };
        for row in self.cells.chunks(self.width.max(1)).rev() {
            bytes.extend(row.iter().map(shade));
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::Point;

    use super::super::{GreyMap, RosMapHeader};
    use super::*;

    proptest! {
        #[test]
        fn what_is_written_is_read_again(
            width in 1_usize..9, height in 1_usize..9, kinds in proptest::collection::vec(0_u8..3, 64), x in -9..9,
        ) {
            let kind = |kind: &u8| [MapCell::Free, MapCell::Occupied, MapCell::Unknown][*kind as usize];
            let map = RosMap {
                width,
                height,
                resolution: 0.05,
                origin: Point::new(f64::from(x), 0.5),
                cells: kinds[..width * height].iter().map(kind).collect(),
            };
            let header = RosMapHeader::parse(&map.yaml("hall.pgm")).unwrap();
            let picture = GreyMap::parse(&map.pgm()).unwrap();
            prop_assert_eq!(RosMap::of(&header, &picture), map);
        }
    }
}
