use alloc::sync::Arc;
use alloc::vec;
use alloc::vec::Vec;

use super::feature_space::Part;
use super::record_span::{RecordSpan, Spanned};
use super::{
    FeatureChoice, FeatureError, FeatureGroup, FeatureScaling, FeatureSpace, PlaceMapError,
    PlaceRecord,
};

/// Form in which a table stores images.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum ImageForm {
    /// The values of the images' pixels.
    #[default]
    Pixels,
    /// Orthonormal coordinates in the span of the table's images: at most one per record, instead
    /// of 3600 or 14400 values per picture. All distances stay the same, up to what is left out,
    /// and so does every map.
    Span {
        /// Maximum squared distance of an image from the span, as a share of the images' mean
        /// squared distance from their mean. 0 leaves out only the rounding of `f32`.
        left_out: f64,
    },
}

/// The features of many records, scaled by their variation over the records.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_maps::place_map::{FeatureChoice, FeatureTable, ImageForm, PlaceRecord};
/// use tolman_robot::{Picture, Snapshot, pioneer_2dx};
///
/// let record = |x: f64| {
///     let mut picture = Picture::black(80, 60, pioneer_2dx::CAMERA);
///     picture.pixels.fill([100 * x as u8, 0, 0]);
///     let snapshot = Snapshot { soundings: vec![], picture: Some(picture) };
///     PlaceRecord { odometry: Pose::new(Point::new(x, 0.0), Heading::EAST), snapshot }
/// };
/// let records = [record(0.0), record(1.0), record(2.0)];
/// let pixels = FeatureTable::of(&records, &FeatureChoice::default(), ImageForm::Pixels)?;
/// let span = FeatureTable::of(&records, &FeatureChoice::default(), ImageForm::Span { left_out: 0.0 })?;
/// assert_eq!(pixels.space().dimension(), 40 * 30 * 3 + 2);
/// assert!(span.space().dimension() <= 3 + 2);
/// # Ok::<(), tolman_maps::place_map::FeatureError>(())
/// ```
#[derive(Clone, Debug)]
pub struct FeatureTable {
    space: Arc<FeatureSpace>,
    rows: Vec<Vec<f32>>,
}

impl FeatureTable {
    /// Returns the features of records. Include the records that the map will be asked about.
    ///
    /// O(records × values); of images in [`ImageForm::Span`] O(records² × values) once.
    ///
    /// # Errors
    /// If there are no records, or one lacks a chosen feature.
    pub fn of(
        records: &[PlaceRecord],
        choice: &FeatureChoice,
        form: ImageForm,
    ) -> Result<Self, FeatureError> {
        refuse_twice(choice)?;
        let first = records.first().ok_or(FeatureError::NoRecords)?;
        let picture = first.snapshot.picture.as_ref();
        let mut space = FeatureSpace {
            parts: Vec::new(),
            camera: picture.map(|picture| picture.camera),
            span: None,
        };
        let mut rows = vec![Vec::new(); records.len()];
        for group in &choice.groups {
            let values = of_all(records, *group)?;
            space.take_in(*group, values, choice.scaling, form, &mut rows);
        }
        if space.dimension() == 0 {
            return Err(FeatureError::NoFeatures);
        }
        let space = Arc::new(space);
        Ok(Self { space, rows })
    }

    /// Returns the space of the features.
    #[must_use]
    pub const fn space(&self) -> &Arc<FeatureSpace> {
        &self.space
    }

    /// Returns the features of a record.
    ///
    /// # Errors
    /// [`PlaceMapError::NoSuchRecord`] beyond the last record.
    pub fn row(&self, record: usize) -> Result<&[f32], PlaceMapError> {
        let count = self.len();
        let row = self.rows.get(record).map(Vec::as_slice);
        row.ok_or(PlaceMapError::NoSuchRecord { record, count })
    }

    /// Returns the number of records.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.rows.len()
    }

    /// Returns whether there are no records, which never happens.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}

impl FeatureSpace {
    /// Appends a group to the rows, with the values of each record.
    fn take_in(
        &mut self,
        group: FeatureGroup,
        mut values: Vec<Vec<f32>>,
        scaling: FeatureScaling,
        form: ImageForm,
        rows: &mut [Vec<f32>],
    ) {
        let scale = scale(&values, scaling);
        if let (FeatureGroup::Image(_), ImageForm::Span { left_out }) = (group, form) {
            let Spanned { span, coordinates } = RecordSpan::of(&values, left_out);
            (self.span, values) = (Some(span), coordinates);
        }
        let len = values.first().map_or(0, Vec::len);
        self.parts.push(Part { group, len, scale });
        for (row, values) in rows.iter_mut().zip(values) {
            row.extend(values.into_iter().map(|value| value * scale));
        }
    }
}

fn refuse_twice(choice: &FeatureChoice) -> Result<(), FeatureError> {
    let mut names: Vec<&'static str> = choice.groups.iter().map(|group| group.name()).collect();
    names.sort_unstable();
    let twice = names.windows(2).find(|pair| pair[0] == pair[1]);
    twice.map_or(Ok(()), |pair| {
        let group = pair[0];
        Err(FeatureError::ChosenTwice { group })
    })
}

/// Returns the values of one group for each record, unscaled; all have the same number.
fn of_all(records: &[PlaceRecord], group: FeatureGroup) -> Result<Vec<Vec<f32>>, FeatureError> {
    let values = records.iter().enumerate();
    let values = values.map(|(number, record)| group.values(record, number));
    let values: Vec<Vec<f32>> = values.collect::<Result<_, _>>()?;
    let expected = values.first().map_or(0, Vec::len);
    match values.iter().position(|values| values.len() != expected) {
        None => Ok(values),
        Some(record) => Err(FeatureError::OtherSoundings {
            record,
            expected,
            found: values[record].len(),
        }),
    }
}

/// Returns the factor of a group's values; 1 for a group that does not vary.
fn scale(values: &[Vec<f32>], scaling: FeatureScaling) -> f32 {
    let len = values.first().map_or(0, Vec::len);
    let variance: f64 = (0..len).map(|index| variance(values, index)).sum();
    let divisor = match scaling {
        FeatureScaling::Group => variance,
        FeatureScaling::Value => variance / len as f64,
        FeatureScaling::Raw => 1.0,
    };
    if divisor > 0.0 {
        (1.0 / libm::sqrt(divisor)) as f32
    } else {
        1.0
    }
}

/// Returns the variance of one value over all records.
fn variance(values: &[Vec<f32>], index: usize) -> f64 {
    let count = values.len() as f64;
    let column = || values.iter().map(|values| f64::from(values[index]));
    let mean = column().sum::<f64>() / count;
    let squares: f64 = column().map(|value| (value - mean) * (value - mean)).sum();
    squares / count
}
