//! Messages of ROS 1 and of ROS 2, in the common data representation (CDR): only the fields that
//! are needed.

use tolman_geom::nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// A message of a bag, not yet decoded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Message<'a> {
    pub(super) topic: &'a str,
    /// Type, as its bag names it.
    pub(super) kind: &'a str,
    pub(super) encoding: Encoding,
    /// Time of receipt, s.
    pub(super) received: f64,
    pub(super) data: &'a [u8],
}

/// How numbers and texts are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Cdr,
    Ros1,
}

/// Times of a message, s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Times {
    /// Time in its header.
    pub(super) header: f64,
    pub(super) received: f64,
}

/// Time in a message's header, s, and its frame, without a leading slash.
pub(super) struct Header {
    pub(super) time: f64,
    pub(super) frame: String,
}

pub(super) struct LaserScan {
    pub(super) header: Header,
    pub(super) angle_min: f32,
    pub(super) angle_increment: f32,
    pub(super) range_min: f32,
    pub(super) range_max: f32,
    pub(super) ranges: Vec<f32>,
}

pub(super) struct Odometry {
    pub(super) header: Header,
    pub(super) child: String,
    pub(super) pose: Isometry3<f64>,
}

pub(super) struct Transform {
    pub(super) header: Header,
    pub(super) child: String,
    pub(super) pose: Isometry3<f64>,
}

/// Kinds of messages that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    LaserScan,
    /// A scan whose beams may have several echoes, of which the first counts.
    MultiEchoLaserScan,
    Odometry,
    Transforms,
}

impl Kind {
    /// Returns the kind of messages of a type of ROS 1 or 2.
    pub(super) fn of(name: &str) -> Option<Self> {
        Some(match name.replace("/msg/", "/").as_str() {
            "sensor_msgs/LaserScan" => Self::LaserScan,
            "sensor_msgs/MultiEchoLaserScan" => Self::MultiEchoLaserScan,
            "nav_msgs/Odometry" => Self::Odometry,
            "tf2_msgs/TFMessage" | "tf/tfMessage" => Self::Transforms,
            _ => return None,
        })
    }
}

/// Reason why a message cannot be used.
pub(super) type Cut = &'static str;

const SHORT: Cut = "a message that ends early";

/// The fields of a message, read one by one.
pub(super) struct Fields<'a> {
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
    is_little: bool,
    /// Maximum alignment of a number, bytes.
    alignment: usize,
}

impl<'a> Fields<'a> {
    pub(super) fn of(message: &Message<'a>) -> Result<Self, Cut> {
        let plain = Self {
            bytes: message.data,
            at: 0,
            encoding: message.encoding,
            is_little: true,
            alignment: 1,
        };
        if message.encoding == Encoding::Ros1 {
            return Ok(plain);
        }
        let (head, bytes) = message.data.split_first_chunk::<4>().ok_or(SHORT)?;
        Ok(Self {
            bytes,
            is_little: head[1] & 1 == 1,
            // The second version of CDR aligns to 4 bytes.
            alignment: if head[1] >= 6 { 4 } else { 8 },
            ..plain
        })
    }

    fn bytes(&mut self, count: usize) -> Result<&'a [u8], Cut> {
        let rest = self.bytes.get(self.at..).ok_or(SHORT)?;
        self.at = self.at.saturating_add(count);
        rest.get(..count).ok_or(SHORT)
    }

    fn number<const N: usize>(&mut self) -> Result<[u8; N], Cut> {
        self.at = self.at.next_multiple_of(N.min(self.alignment));
        let mut number: [u8; N] = self.bytes(N)?.try_into().map_err(|_| SHORT)?;
        if !self.is_little {
            number.reverse();
        }
        Ok(number)
    }

    fn count(&mut self) -> Result<usize, Cut> {
        Ok(u32::from_le_bytes(self.number()?) as usize)
    }

    fn float(&mut self) -> Result<f32, Cut> {
        Ok(f32::from_le_bytes(self.number()?))
    }

    fn double(&mut self) -> Result<f64, Cut> {
        Ok(f64::from_le_bytes(self.number()?))
    }

    fn text(&mut self) -> Result<String, Cut> {
        let size = self.count()?;
        let bytes = self.bytes(size)?;
        let text = String::from_utf8_lossy(bytes);
        Ok(text.trim_end_matches('\0').to_owned())
    }

    fn frame(&mut self) -> Result<String, Cut> {
        Ok(self.text()?.trim_start_matches('/').to_owned())
    }

    pub(super) fn header(&mut self) -> Result<Header, Cut> {
        if self.encoding == Encoding::Ros1 {
            self.count()?;
        }
        let seconds = i32::from_le_bytes(self.number()?);
        let nanoseconds = u32::from_le_bytes(self.number()?);
        Ok(Header {
            time: f64::from(seconds) + 1e-9 * f64::from(nanoseconds),
            frame: self.frame()?,
        })
    }

    /// Reads a position and a quaternion x, y, z, w.
    fn pose(&mut self) -> Result<Isometry3<f64>, Cut> {
        let at = Translation3::new(self.double()?, self.double()?, self.double()?);
        let (x, y, z, w) = (
            self.double()?,
            self.double()?,
            self.double()?,
            self.double()?,
        );
        let turned = Quaternion::new(w, x, y, z);
        // Some programs leave the orientation out.
        let turned = match turned.norm() > 1e-6 {
            true => UnitQuaternion::new_normalize(turned),
            false => UnitQuaternion::identity(),
        };
        Ok(Isometry3::from_parts(at, turned))
    }

    fn floats(&mut self) -> Result<Vec<f32>, Cut> {
        let count = self.count()?;
        let mut floats = Vec::new();
        for _ in 0..count {
            floats.push(self.float()?);
        }
        Ok(floats)
    }

    pub(super) fn scan(&mut self, kind: Kind) -> Result<LaserScan, Cut> {
        let header = self.header()?;
        let (angle_min, _, angle_increment) = (self.float()?, self.float()?, self.float()?);
        let (_, _) = (self.float()?, self.float()?);
        let (range_min, range_max) = (self.float()?, self.float()?);
        let ranges = match kind {
            Kind::MultiEchoLaserScan => {
                let mut ranges = Vec::new();
                for _ in 0..self.count()? {
                    ranges.push(self.floats()?.first().copied().unwrap_or(f32::NAN));
                }
                ranges
            }
            _ => self.floats()?,
        };
        Ok(LaserScan {
            header,
            angle_min,
            angle_increment,
            range_min,
            range_max,
            ranges,
        })
    }

    pub(super) fn odometry(&mut self) -> Result<Odometry, Cut> {
        Ok(Odometry {
            header: self.header()?,
            child: self.frame()?,
            pose: self.pose()?,
        })
    }

    pub(super) fn transforms(&mut self) -> Result<Vec<Transform>, Cut> {
        let mut transforms = Vec::new();
        for _ in 0..self.count()? {
            transforms.push(Transform {
                header: self.header()?,
                child: self.frame()?,
                pose: self.pose()?,
            });
        }
        Ok(transforms)
    }
}
