"""What a description of a way says, as records that readers and writers share."""
