"""Writes a bag by ROS 1's own library, as a second opinion for the reader: write_bag.py FILE COMPRESSION.

Frame k (0, 1, 2) at 1700000000 s + k/30 s: depth 16 x 12 of 1000 + 100 k + the pixel's number, 0 at the first
pixel; colour of (10, 20, k) as rgb8, 4 ms later; the camera once.
"""

import sys

import numpy
import rosbag
import rospy
from sensor_msgs.msg import CameraInfo, Image

WIDTH, HEIGHT, FRAMES = 16, 12, 3


def image(stamp, pixels, encoding):
    message = Image(height=HEIGHT, width=WIDTH, encoding=encoding, step=pixels.nbytes // HEIGHT, data=pixels.tobytes())
    message.header.stamp = stamp
    return message


def main():
    path, compression = sys.argv[1:]
    camera = CameraInfo(height=HEIGHT, width=WIDTH, distortion_model="plumb_bob", D=[0.0] * 5,
                        K=[500.5, 0, 8.25, 0, 501.5, 5.75, 0, 0, 1])
    with rosbag.Bag(path, "w", compression=compression, chunk_threshold=2000) as bag:
        begin = rospy.Time(1700000000)
        bag.write("/camera/depth/camera_info", camera, begin)
        for k in range(FRAMES):
            stamp = begin + rospy.Duration.from_sec(k / 30)
            depth = (1000 + 100 * k + numpy.arange(WIDTH * HEIGHT)).astype("<u2")
            depth[0] = 0
            colour = numpy.tile(numpy.array([10, 20, k], numpy.uint8), (HEIGHT, WIDTH, 1))
            bag.write("/camera/depth/image_raw", image(stamp, depth, "16UC1"), stamp)
            late = stamp + rospy.Duration.from_sec(0.004)
            bag.write("/camera/color/image_raw", image(late, colour, "rgb8"), late)


main()
