<?xml version="1.0" encoding="windows-1252"?>
<!-- SPDX-FileCopyrightText: The Far-LoD authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:g="http://www.opengis.net/gml" xmlns:b="http://www.opengis.net/citygml/building/2.0" xmlns:x="http://www.w3.org/1999/xlink">
<cityObjectMember><b:Building g:id="a"><b:measuredHeight uom="m">7.5</b:measuredHeight>
<b:lod0FootPrint><g:MultiSurface><g:surfaceMember><g:Polygon g:id="p"><g:exterior><g:LinearRing srsDimension="3"><g:posList>0 0 1 4 0 1 4 3 1 0 0 1</g:posList></g:LinearRing></g:exterior></g:Polygon></g:surfaceMember></g:MultiSurface></b:lod0FootPrint>
<b:lod2Solid><g:Solid g:id="s"><g:exterior><g:CompositeSurface><g:surfaceMember x:href="#q"/><g:surfaceMember><g:OrientableSurface orientation="-"><g:baseSurface x:href="#p"/></g:OrientableSurface></g:surfaceMember></g:CompositeSurface></g:exterior></g:Solid></b:lod2Solid>
<b:boundedBy><b:RoofSurface><b:lod2MultiSurface><g:MultiSurface><g:surfaceMember><g:Polygon g:id="q"><g:exterior><g:LinearRing><g:pos>0 0 5</g:pos><g:pos>4 0 5</g:pos><g:pos>4 3 5</g:pos><g:pos>0 0 5</g:pos></g:LinearRing></g:exterior><g:interior><g:LinearRing><g:coordinates>1,1,5 2,1,5 2,2,5</g:coordinates></g:LinearRing></g:interior></g:Polygon></g:surfaceMember></g:MultiSurface></b:lod2MultiSurface></b:RoofSurface></b:boundedBy>
<b:consistsOfBuildingPart><b:BuildingPart><b:lod1MultiSurface><g:MultiSurface><g:surfaceMember x:href="#r"/></g:MultiSurface></b:lod1MultiSurface></b:BuildingPart></b:consistsOfBuildingPart>
</b:Building></cityObjectMember>
<cityObjectMember><b:Building g:id="c"><b:outerBuildingInstallation><b:BuildingInstallation><b:lod2Geometry><g:Polygon g:id="r"><g:exterior><g:LinearRing><g:posList>0 0 1 4 0 1 4 3 1 0 0 1</g:posList></g:LinearRing></g:exterior></g:Polygon></b:lod2Geometry></b:BuildingInstallation></b:outerBuildingInstallation>
<b:lod2MultiSurface x:href="#s"/></b:Building></cityObjectMember>
</CityModel>
