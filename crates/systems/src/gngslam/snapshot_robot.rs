use tolman_robot::{Bumps, Robot, Rolls, TakesSnapshots, TurnTranslate};

/// A robot that GNG-SLAM can drive: it turns and translates, takes snapshots, and feels its way and
/// what it bumps into.
///
/// Every robot with these abilities is one.
pub trait SnapshotRobot:
    Robot<Command = TurnTranslate, Sensing: TakesSnapshots + Rolls + Bumps>
{
}

impl<R> SnapshotRobot for R where
    R: Robot<Command = TurnTranslate, Sensing: TakesSnapshots + Rolls + Bumps>
{
}
