"""What the robot perceives without pictures: sight by rays, LiDAR, odometry, turning points.

They tell what is truly there; what a detector makes of it is in `perception`.
"""
