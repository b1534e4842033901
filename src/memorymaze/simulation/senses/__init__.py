"""What the robot perceives without pictures: rays, LiDAR, odometry, turning points."""
