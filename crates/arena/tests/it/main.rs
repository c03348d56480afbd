//! The arena seen from outside.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

extern crate alloc;

mod any_size;
mod better_map;
mod brain_service;
mod certificate;
mod contest;
mod cpm;
mod entry;
mod episodes;
mod errands;
#[cfg(unix)]
mod foreign;
mod gngslam;
mod laser_diktiometry;
mod noisy_mouse;
mod office_robot;
mod online_slam;
mod own_heading;
mod pioneer_mouse;
mod place_scores;
mod rats;
mod registry;
mod stepped;
mod survey_file;
mod surveys;
